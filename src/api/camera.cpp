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

// Largest cosine between what a camera's matrices make of two axes that must be orthogonal.
constexpr double kShearMax = 1e-6;

DVec3 arrayOf(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

void requireCamera(bool is_valid, const char* problem)
{
    if (!is_valid)
    {
        throw Error(ErrorCode::Usage, fmt::format("the matrices of a camera {}", problem));
    }
}

// The axes of a picture: how far a step of 1 to the right, down, and along depth goes in the world, and where 0 is.
struct PictureAxes
{
    glm::dvec3 right;
    glm::dvec3 down;
    glm::dvec3 deep;
    glm::dvec3 origin;
};

// Inverts three rows of a matrix from the world.
PictureAxes inverted(const glm::dvec4& right, const glm::dvec4& down, const glm::dvec4& deep)
{
    const glm::dmat3 steps =
        glm::inverse(glm::transpose(glm::dmat3(glm::dvec3(right), glm::dvec3(down), glm::dvec3(deep))));
    const PictureAxes axes = {steps[0], steps[1], steps[2], -(steps * glm::dvec3(right.w, down.w, deep.w))};
    const double sum =
        glm::dot(axes.right + axes.down, glm::dvec3(1)) + glm::dot(axes.deep + axes.origin, glm::dvec3(1));
    requireCamera(std::isfinite(sum), "cannot be inverted: they must be finite, and show a volume");
    const double cosine = glm::dot(glm::normalize(axes.right), glm::normalize(axes.down));
    requireCamera(std::abs(cosine) < kShearMax, "shear: the picture's rows and columns must be at right angles");
    return axes;
}

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

ViewCamera viewOf(const CameraInfo& info, PictureSize size)
{
    const double square = static_cast<double>(size.width) / size.height;
    const double aspect = info.aspect == 0.0 ? square : info.aspect;
    ViewCamera view;
    view.position = toGlm(info.position);
    view.forward = glm::normalize(toGlm(info.forward));
    view.right = glm::normalize(glm::cross(view.forward, toGlm(info.up)));
    view.up = glm::cross(view.right, view.forward);
    view.orthographic = info.orthographic;
    view.vertical_fov = info.vertical_fov;
    view.half_height = info.half_height;
    view.pixel_aspect = info.aspect == 0.0 ? 1.0 : aspect / square;
    view.shift = {info.shift[0] * aspect, info.shift[1]};
    view.right = info.mirrored ? -view.right : view.right;
    const double slant = glm::length(glm::cross(view.forward, glm::normalize(toGlm(info.up))));
    const double extent = info.orthographic ? info.half_height : info.vertical_fov;
    const double extent_max = info.orthographic ? INFINITY : std::numbers::pi;
    const double sum = glm::dot(view.position, glm::dvec3(1)) + glm::dot(view.right + view.up, glm::dvec3(1)) +
                       view.shift.x + view.shift.y;
    if (!std::isfinite(sum) || !(slant > kSlantMin) || !(extent > 0 && extent < extent_max) ||
        !(aspect > 0 && std::isfinite(aspect)))
    {
        throw Error(ErrorCode::Usage,
                    "a camera needs a position, a direction, an up that is not parallel to it, a field of view inside "
                    "(0, pi) or a half height above 0, an aspect of 0 or more and a shift, all of them finite");
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

CameraInfo CameraInfo::ofMatrices(const DMat4& view, const DMat4& projection, const ClipSpace& clip)
{
    const glm::dmat4 rows = glm::transpose(toGlm(projection) * toGlm(view));
    const glm::dvec4 down = clip.y_up ? -rows[1] : rows[1];
    CameraInfo info;
    info.orthographic = glm::dvec3(rows[3]) == glm::dvec3(0);
    PictureAxes axes;
    glm::dvec3 forward;
    if (info.orthographic)
    {
        axes = inverted(rows[0] / rows[3].w, down / rows[3].w, rows[2] / rows[3].w);
        requireCamera(std::abs(glm::dot(glm::normalize(axes.right), glm::normalize(axes.deep))) < kShearMax &&
                          std::abs(glm::dot(glm::normalize(axes.down), glm::normalize(axes.deep))) < kShearMax,
                      "shear: the picture must be at right angles to the depth");
        forward = clip.reversed_depth ? -axes.deep : axes.deep;
        axes.origin += clip.reversed_depth ? axes.deep : glm::dvec3(0); // depth 1 is near
    }
    else
    {
        // A step along depth goes through the picture's middle; its part along the camera's axis has length 1.
        axes = inverted(rows[0], down, rows[3]);
        const glm::dvec3 axis = glm::normalize(glm::cross(axes.right, axes.down));
        const double step = glm::dot(axis, axes.deep);
        forward = step < 0 ? -axis : axis;
        axes.right /= std::abs(step);
        axes.down /= std::abs(step);
        axes.deep /= std::abs(step);
        info.shift = {glm::dot(axes.deep, axes.right) / glm::dot(axes.right, axes.right),
                      -glm::dot(axes.deep, axes.down) / glm::dot(axes.down, axes.down)};
    }
    info.position = arrayOf(axes.origin);
    info.forward = arrayOf(glm::normalize(forward));
    info.up = arrayOf(-glm::normalize(axes.down));
    info.half_height = glm::length(axes.down);
    info.vertical_fov = 2.0 * std::atan(info.half_height);
    info.aspect = glm::length(axes.right) / info.half_height;
    info.mirrored = glm::dot(glm::cross(forward, -axes.down), axes.right) < 0;
    return info;
}

CameraRays cameraRays(const CameraInfo& camera, const GridInfo& grid, std::uint32_t width, std::uint32_t height)
{
    const PictureSize size = {checkedEdge(width), checkedEdge(height)};
    const gpu::CameraRays rays = traceCamera(viewOf(camera, size), checkedGrid(grid), size.height).rays;
    return {arrayOf(rays.origin), arrayOf(rays.forward), arrayOf(rays.half_pixel_x), arrayOf(rays.half_pixel_y)};
}

} // namespace zvo
