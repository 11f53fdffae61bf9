// SPDX-License-Identifier: MIT
#include "core/path/aov.h"

#include "core/path/strips.h"

namespace zvo
{

namespace
{

// Of a pixel's ray, per unit of depth, from the camera's origin for perspective cameras.
glm::dvec3 offsetOf(const TraceCamera& camera, const glm::dvec2& pixel, const glm::dvec2& size)
{
    const glm::dvec2 n = 2.0 * pixel + 1.0 - size;
    return n.x * glm::dvec3(camera.rays.half_pixel_x) + n.y * glm::dvec3(camera.rays.half_pixel_y);
}

// From a camera to a place. is_direction: the place is infinitely far in that direction.
glm::dvec3 wayTo(const TraceCamera& camera, const glm::dvec3& place, bool is_direction)
{
    return is_direction ? place : place - glm::dvec3(camera.rays.origin);
}

double depthOf(const TraceCamera& camera, const glm::dvec3& place, bool is_direction)
{
    return glm::dot(wayTo(camera, place, is_direction), glm::dvec3(camera.axis));
}

// Where a place before a camera is in its picture.
glm::dvec2 pixelOf(const TraceCamera& camera, const glm::dvec3& place, bool is_direction, const glm::dvec2& size)
{
    const glm::dvec3 way = wayTo(camera, place, is_direction);
    const glm::dvec3 shift = glm::dvec3(camera.rays.forward) - glm::dvec3(camera.axis);
    const glm::dvec3 offset = camera.orthographic ? way : way / depthOf(camera, place, is_direction) - shift;
    const glm::dvec3 right = camera.rays.half_pixel_x;
    const glm::dvec3 down = camera.rays.half_pixel_y;
    const glm::dvec2 n = {glm::dot(offset, right) / glm::dot(right, right),
                          glm::dot(offset, down) / glm::dot(down, down)};
    return 0.5 * (n + size - 1.0);
}

} // namespace

AovImages aovsOf(std::span<const gpu::PixelFeatures> features, std::uint32_t width, std::uint32_t height,
                 std::uint32_t sample_count, const Grid& grid, const TraceCamera& camera,
                 const TraceCamera& camera_before)
{
    const std::size_t pixel_count = features.size();
    AovImages images = {std::vector<glm::vec3>(pixel_count), std::vector<glm::vec3>(pixel_count),
                        std::vector<float>(pixel_count), std::vector<glm::vec2>(pixel_count)};
    const float part = 1.0F / static_cast<float>(sample_count);
    const double unit = double{grid.voxel_size} * grid.rootResolution();
    const glm::dvec2 size = {width, height};
    forEachPixel(width, height,
                 [&](std::size_t number, std::uint32_t x, std::uint32_t y)
                 {
                     const gpu::PixelFeatures& sum = features[number];
                     const std::size_t pixel = std::size_t{y} * width + x;
                     const bool hits = sum.hits > 0.0F;
                     const double depth = hits ? double{sum.depth} / sum.hits : 1.0;
                     images.albedo[pixel] = part * sum.albedo;
                     images.normal[pixel] = part * sum.normal;
                     images.depth[pixel] = hits ? static_cast<float>(unit * depth) : AovImages::kNoDepth;

                     const glm::dvec2 at = {x, y};
                     const glm::dvec3 offset = offsetOf(camera, at, size);
                     const glm::dvec3 way =
                         depth * glm::dvec3(camera.rays.forward) + (camera.orthographic ? 1.0 : depth) * offset;
                     const bool is_direction = !hits && !camera.orthographic;
                     const glm::dvec3 place = is_direction ? way : way + glm::dvec3(camera.rays.origin);
                     const bool is_behind =
                         !camera_before.orthographic && depthOf(camera_before, place, is_direction) <= 0.0;
                     images.motion[pixel] = is_behind
                                                ? glm::vec2(AovImages::kNoMotion)
                                                : glm::vec2(pixelOf(camera_before, place, is_direction, size) - at);
                 });
    return images;
}

} // namespace zvo
