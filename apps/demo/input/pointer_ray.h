// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"

#include <cmath>
#include <optional>

namespace zvo::demo
{

/// A line of sight in world space.
struct PointerRay
{
    glm::dvec3 origin;
    glm::dvec3 direction; // any length
};

/// The ray through a point of the window: x to the right and y down, from its top left corner; width and height in the
/// same units.
inline PointerRay pointerRay(const ViewCamera& camera, const glm::dvec2& at, const glm::dvec2& size)
{
    const glm::dvec2 from_center = (2.0 * at - size) / size.y;
    const double half_height = camera.orthographic ? camera.half_height : std::tan(0.5 * camera.vertical_fov);
    const glm::dvec3 offset = half_height * (from_center.x * camera.right - from_center.y * camera.up);
    return camera.orthographic ? PointerRay{camera.position + offset, camera.forward}
                               : PointerRay{camera.position, camera.forward + offset};
}

/// The point of the window at which a camera sees a point, as pointerRay() takes it. Nothing behind the camera.
inline std::optional<glm::dvec2> pointOf(const ViewCamera& camera, const glm::dvec3& point, const glm::dvec2& size)
{
    const glm::dvec3 away = point - camera.position;
    const double depth = glm::dot(away, camera.forward);
    const double half_height = camera.orthographic ? camera.half_height : depth * std::tan(0.5 * camera.vertical_fov);
    if (!(depth > 0) || !(half_height > 0))
    {
        return std::nullopt;
    }
    const glm::dvec2 from_center = {glm::dot(away, camera.right), -glm::dot(away, camera.up)};
    return 0.5 * (size + size.y / half_height * from_center);
}

/// The point of a ray on the plane through `through` that faces the camera.
inline glm::dvec3 onPlane(const PointerRay& ray, const ViewCamera& camera, const glm::dvec3& through)
{
    const double along = glm::dot(ray.direction, camera.forward); // above 0: rays go forward
    return ray.origin + glm::dot(through - ray.origin, camera.forward) / along * ray.direction;
}

} // namespace zvo::demo
