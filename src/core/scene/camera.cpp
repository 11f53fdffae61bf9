// SPDX-License-Identifier: MIT
#include "core/scene/camera.h"

#include "zvo/error.h"

#include <algorithm>
#include <array>
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

using Points = std::array<glm::dvec3, 8>; // in a camera's axes: right, up, forward

// The largest depth of a camera that shows the points within a part of its picture. Along x, a camera at c shows those
// for which |x - c.x| <= tangent * (z - c.z): of c.x - tangent * c.z and of -c.x - tangent * c.z that bounds each.
double depthShowing(const Points& points, int axis, double tangent)
{
    double high = -INFINITY;
    double low = -INFINITY;
    for (const glm::dvec3& point : points)
    {
        high = std::max(high, point[axis] - tangent * point.z);
        low = std::max(low, -point[axis] - tangent * point.z);
    }
    return -0.5 * (high + low) / tangent;
}

// Where a camera at that depth has as much of the picture on both sides of the points: in the middle of the two that
// are farthest apart in its picture.
double centerShowing(const Points& points, int axis, double depth)
{
    double most = -1.0;
    double center = 0.0;
    for (const glm::dvec3& a : points)
    {
        for (const glm::dvec3& b : points)
        {
            const double sum = a.z - depth + b.z - depth;
            const double tangent = (a[axis] - b[axis]) / sum;
            if (tangent > most)
            {
                most = tangent;
                center = (a[axis] * (b.z - depth) + b[axis] * (a.z - depth)) / sum;
            }
        }
    }
    return center;
}

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

ViewCamera ViewCamera::framing(const Bounds& bounds, double aspect)
{
    return framing(bounds, aspect, kFramingDirection);
}

ViewCamera ViewCamera::framing(const Bounds& bounds, double aspect, const glm::dvec3& direction)
{
    ViewCamera camera;
    camera.vertical_fov = kFramingFov;
    setAxes(camera, direction);
    if (!isFinite(bounds.min) || !isFinite(bounds.max))
    {
        return camera; // nothing to show
    }
    const glm::dmat3 axes(camera.right, camera.up, camera.forward);
    Points points;
    double nearest = INFINITY;
    for (int i = 0; i < 8; ++i)
    {
        const glm::bvec3 side((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
        points.at(i) = glm::dvec3(glm::mix(bounds.min, bounds.max, side)) * axes;
        nearest = std::min(nearest, points.at(i).z);
    }
    const double tangent = kFramingFill * std::tan(0.5 * kFramingFov);
    const double depth = std::min(depthShowing(points, 0, tangent * aspect), depthShowing(points, 1, tangent));
    const double at = depth < nearest ? depth : nearest - 1.0; // a single point
    camera.position = axes * glm::dvec3(centerShowing(points, 0, at), centerShowing(points, 1, at), at);
    return camera;
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
    result.axis = result.rays.forward;
    result.rays.half_pixel_x = glm::vec3(half_pixel * camera.pixel_aspect * camera.right);
    result.rays.half_pixel_y = glm::vec3(-half_pixel * camera.up);
    if (camera.shift != glm::dvec2(0.0))
    {
        const glm::dvec3 shift = half_height * (camera.shift.x * camera.right + camera.shift.y * camera.up);
        (camera.orthographic ? result.rays.origin : result.rays.forward) += glm::vec3(shift);
    }
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
