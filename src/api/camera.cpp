// SPDX-License-Identifier: MIT
#include "api/camera.h"

#include "api/checked.h"
#include "api/convert.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace zvo
{

namespace
{

constexpr std::uint32_t kEdgeMax = 16384; // pixels

// A direction with a larger vertical component counts as vertical.
constexpr double kVertical = 0.999999;

// Least sine of the angle between forward and up. Below it, rounding would decide the camera's up direction.
constexpr double kSlantMin = 1e-9;

Vec3 arrayOf(const gpu::vec3& v)
{
    return {v.x, v.y, v.z};
}

} // namespace

std::uint32_t checkedEdge(std::uint32_t edge)
{
    if (edge == 0 || edge > kEdgeMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a picture has edges from 1 to {} pixels, not {}", kEdgeMax, edge));
    }
    return edge;
}

ViewCamera viewOf(const CameraInfo& info)
{
    ViewCamera view;
    view.position = toGlm(info.position);
    view.forward = glm::normalize(toGlm(info.forward));
    view.right = glm::normalize(glm::cross(view.forward, toGlm(info.up)));
    view.up = glm::cross(view.right, view.forward);
    view.orthographic = info.orthographic;
    view.vertical_fov = info.vertical_fov;
    view.half_height = info.half_height;
    const double slant = glm::length(glm::cross(view.forward, glm::normalize(toGlm(info.up))));
    const double size = info.orthographic ? info.half_height : info.vertical_fov;
    const double size_max = info.orthographic ? INFINITY : std::numbers::pi;
    const double sum = glm::dot(view.position, glm::dvec3(1)) + glm::dot(view.right + view.up, glm::dvec3(1));
    if (!std::isfinite(sum) || !(slant > kSlantMin) || !(size > 0 && size < size_max))
    {
        throw Error(ErrorCode::Usage,
                    "a camera needs a position, a direction, an up that is not parallel to it, and a field of view "
                    "inside (0, pi) or a half height above 0, all of them finite");
    }
    return view;
}

CameraInfo CameraInfo::lookAt(const DVec3& eye, const DVec3& target, double vertical_fov)
{
    CameraInfo info;
    info.position = eye;
    info.vertical_fov = vertical_fov;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        info.forward[axis] = target[axis] - eye[axis];
    }
    const bool vertical = std::abs(glm::normalize(toGlm(info.forward)).y) > kVertical;
    info.up = vertical ? DVec3{0, 0, 1} : DVec3{0, 1, 0};
    return info;
}

CameraRays cameraRays(const CameraInfo& camera, const GridInfo& grid, std::uint32_t height)
{
    const gpu::CameraRays rays = traceCamera(viewOf(camera), checkedGrid(grid), checkedEdge(height)).rays;
    return {arrayOf(rays.origin), arrayOf(rays.forward), arrayOf(rays.half_pixel_x), arrayOf(rays.half_pixel_y)};
}

} // namespace zvo
