// SPDX-License-Identifier: MIT
#include "core/scene/camera.h"

#include "zvo/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace zvo
{

namespace
{

constexpr double kFramingFov = 0.6;   // radians
constexpr double kFramingFill = 0.92; // of the picture
const glm::dvec3 kFramingDirection(-0.55, -0.42, -0.85);

bool isFinite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Sets the axes for a view along direction, which must not be zero.
void setAxes(ViewCamera& camera, const glm::dvec3& direction)
{
    camera.forward = glm::normalize(direction);
    const bool vertical = std::abs(camera.forward.y) > 0.999999;
    const glm::dvec3 upright = vertical ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    camera.right = glm::normalize(glm::cross(camera.forward, upright));
    camera.up = glm::cross(camera.right, camera.forward);
}

/// The nearest camera with a given direction that shows a set of points.
///
/// In the camera's axes, with forward as z, a camera at c shows the points for which |x - c.x| <= t.x (z - c.z) and
/// |y - c.y| <= t.y (z - c.z). Per axis and side that bounds one linear function of c by its maximum over the points.
class Frame
{
public:
    explicit Frame(double aspect, const glm::dvec3& direction = kFramingDirection)
    {
        m_camera.vertical_fov = kFramingFov;
        setAxes(m_camera, direction);
        const double tangent = kFramingFill * std::tan(0.5 * kFramingFov);
        m_tangent = {tangent * aspect, tangent};
    }

    void include(const glm::dvec3& point)
    {
        const glm::dvec2 across(glm::dot(point, m_camera.right), glm::dot(point, m_camera.up));
        const double depth = glm::dot(point, m_camera.forward);
        if (!isFinite(point))
        {
            return;
        }
        m_high = glm::max(m_high, across - m_tangent * depth);
        m_low = glm::max(m_low, -across - m_tangent * depth);
        m_nearest = std::min(m_nearest, depth);
    }

    [[nodiscard]] ViewCamera camera() const
    {
        if (!std::isfinite(m_nearest))
        {
            return m_camera; // there are no points
        }
        const glm::dvec2 across = 0.5 * (m_high - m_low);
        const glm::dvec2 depths = -0.5 * (m_high + m_low) / m_tangent;
        double depth = std::min(depths.x, depths.y);
        depth = depth < m_nearest ? depth : m_nearest - 1.0; // a single point
        ViewCamera camera = m_camera;
        camera.position = across.x * camera.right + across.y * camera.up + depth * camera.forward;
        return camera;
    }

private:
    ViewCamera m_camera;
    glm::dvec2 m_tangent{1.0};
    glm::dvec2 m_high{-INFINITY};
    glm::dvec2 m_low{-INFINITY};
    double m_nearest = INFINITY;
};

} // namespace

ViewCamera ViewCamera::of(const Camera& camera)
{
    const glm::dmat4 transform(camera.transform);
    const glm::dvec3 backward(transform[2]);
    const glm::dvec3 upward(transform[1]);
    const glm::dvec3 sideward = glm::cross(upward, backward);
    ViewCamera view;
    view.position = glm::dvec3(transform[3]);
    view.orthographic = camera.orthographic;
    view.vertical_fov = static_cast<double>(camera.vertical_fov);
    view.half_height = static_cast<double>(camera.half_height);
    const double size = glm::length(sideward);
    if (!isFinite(view.position) || !std::isfinite(size) || size == 0.0)
    {
        throw Error(ErrorCode::Input, fmt::format("camera \"{}\" has no direction: its transform is degenerate; choose "
                                                  "another one or give eye and target",
                                                  camera.name));
    }
    view.forward = -glm::normalize(backward);
    view.right = sideward / size;
    view.up = glm::cross(view.right, view.forward);
    return view;
}

ViewCamera ViewCamera::lookAt(const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov)
{
    const glm::dvec3 direction = target - eye;
    if (!isFinite(eye) || !isFinite(target) || glm::length(direction) == 0.0)
    {
        throw Error(ErrorCode::Usage, "the camera's eye and target must be two different points");
    }
    if (!(vertical_fov > 0.0 && vertical_fov < std::numbers::pi))
    {
        throw Error(ErrorCode::Usage, "the camera's field of view must be more than 0 and less than 180 degrees");
    }
    ViewCamera view;
    view.position = eye;
    view.vertical_fov = vertical_fov;
    setAxes(view, direction);
    return view;
}

ViewCamera ViewCamera::framing(const Scene& scene, double aspect)
{
    Frame frame(aspect);
    for (const Instance& instance : scene.instances)
    {
        for (const glm::vec3& position : scene.primitives.at(instance.primitive).positions)
        {
            frame.include(transformPoint(instance.transform, position));
        }
    }
    return frame.camera();
}

ViewCamera ViewCamera::framing(const Bounds& bounds, double aspect)
{
    return framing(bounds, aspect, kFramingDirection);
}

ViewCamera ViewCamera::framing(const Bounds& bounds, double aspect, const glm::dvec3& direction)
{
    Frame frame(aspect, direction);
    for (int corner = 0; corner < 8; ++corner)
    {
        frame.include({(corner & 1) != 0 ? bounds.max.x : bounds.min.x, (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                       (corner & 4) != 0 ? bounds.max.z : bounds.min.z});
    }
    return frame.camera();
}

ViewCamera ViewCamera::turnedAround(const glm::dvec3& center, double radians) const
{
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    const auto turn = [c, s](const glm::dvec3& v) { return glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
    ViewCamera view = *this;
    view.position = center + turn(position - center);
    view.forward = turn(forward);
    view.right = turn(right);
    view.up = turn(up);
    return view;
}

TraceCamera traceCamera(const ViewCamera& camera, const Grid& grid, std::uint32_t height)
{
    const double edge = static_cast<double>(grid.voxel_size) * grid.rootResolution();
    const double half_height = camera.orthographic ? camera.half_height / edge : std::tan(0.5 * camera.vertical_fov);
    const double half_pixel = half_height / height;
    TraceCamera result;
    result.orthographic = camera.orthographic;
    result.rays.origin = glm::vec3(1.0 + (camera.position - glm::dvec3(grid.origin)) / edge);
    result.rays.forward = glm::vec3(camera.forward);
    result.rays.half_pixel_x = glm::vec3(half_pixel * camera.right);
    result.rays.half_pixel_y = glm::vec3(-half_pixel * camera.up);
    return result;
}

TraceCamera shifted(const TraceCamera& camera, const glm::vec2& pixels)
{
    TraceCamera result = camera;
    const glm::vec3 shift = 2.0F * (pixels.x * camera.rays.half_pixel_x + pixels.y * camera.rays.half_pixel_y);
    (camera.orthographic ? result.rays.origin : result.rays.forward) += shift;
    return result;
}

glm::vec2 pointOfPixel(std::uint32_t sample)
{
    constexpr glm::dvec2 kSteps = {0.7548776662466927, 0.5698402909980532};
    const glm::dvec2 point = glm::fract(0.5 + static_cast<double>(sample) * kSteps) - 0.5;
    return point;
}

} // namespace zvo
