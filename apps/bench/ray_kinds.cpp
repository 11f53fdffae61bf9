// SPDX-License-Identifier: MIT
#include "bench/ray_kinds.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace zvo::cli
{

namespace
{

// In [0, 1), from 24 bits.
float uniform(std::mt19937& random)
{
    return static_cast<float>(random() >> 8) * 0x1p-24F;
}

// A ray that begins a little above a face, since other programs would hit the face's voxel.
PrimaryRay rayFrom(const Grid& grid, const FacePoint& point, const glm::vec3& direction, float reach)
{
    return {point.position, direction, 1e-3F / static_cast<float>(grid.rootResolution()), reach};
}

} // namespace

gpu::Ray deviceRay(const PrimaryRay& ray)
{
    constexpr float kLeast = 1e-20F; // as in lib/ray.glsl
    gpu::Ray result{ray.origin, ray.t_min, {}, ray.t_max};
    for (int axis = 0; axis < 3; ++axis)
    {
        const float along = ray.direction[axis];
        result.inverse_direction[axis] = 1.0F / (std::abs(along) < kLeast ? std::copysign(kLeast, along) : along);
    }
    return result;
}

std::vector<FacePoint> facePoints(std::span<const PrimaryRay> rays, std::span<const gpu::Hit> hits)
{
    constexpr float kUlp = std::numeric_limits<float>::epsilon(); // in unit space
    constexpr std::uint64_t kMask = (std::uint64_t{1} << gpu::kHitCoordinateBits) - 1;
    std::vector<FacePoint> points;
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
        const std::uint64_t where = hits[i].where.x | std::uint64_t{hits[i].where.y} << 32;
        const auto axis = static_cast<std::uint32_t>(where >> gpu::kHitFaceShift & 3);
        if (hits[i].index == gpu::kHitMiss || axis == gpu::kFaceInside)
        {
            continue;
        }
        const float edge = std::ldexp(1.0F, -2 * static_cast<int>(where >> gpu::kHitLevelShift & 15));
        const glm::vec3 cell(where & kMask, where >> gpu::kHitCoordinateBits & kMask,
                             where >> (2 * gpu::kHitCoordinateBits) & kMask);
        const glm::vec3 low = 1.0F + edge * cell;
        const bool is_lower = rays[i].direction[static_cast<int>(axis)] > 0.0F;
        FacePoint point{glm::clamp(rays[i].origin + hits[i].t * rays[i].direction, low + kUlp, low + edge - kUlp),
                        static_cast<int>(axis), is_lower ? -1.0F : 1.0F};
        point.position[point.axis] = low[point.axis] + (is_lower ? 0.0F : edge);
        points.push_back(point);
    }
    return points;
}

std::vector<PrimaryRay> raysToward(const Grid& grid, std::span<const FacePoint> points, const glm::vec3& direction)
{
    std::vector<PrimaryRay> rays;
    for (const FacePoint& point : points)
    {
        if (point.side * direction[point.axis] > 0.0F)
        {
            rays.push_back(rayFrom(grid, point, direction, std::numeric_limits<float>::infinity()));
        }
    }
    return rays;
}

std::vector<PrimaryRay> scatteredRays(const Grid& grid, std::span<const FacePoint> points, float reach,
                                      std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<PrimaryRay> rays;
    for (const FacePoint& point : points)
    {
        const float u = uniform(random);
        const float angle = 2.0F * std::numbers::pi_v<float> * uniform(random);
        glm::vec3 direction;
        direction[point.axis] = point.side * std::sqrt(1.0F - u);
        direction[(point.axis + 1) % 3] = std::sqrt(u) * std::cos(angle);
        direction[(point.axis + 2) % 3] = std::sqrt(u) * std::sin(angle);
        rays.push_back(rayFrom(grid, point, direction, reach));
    }
    return rays;
}

std::vector<PrimaryRay> raysWithin(const glm::vec3& low, const glm::vec3& high, std::size_t count, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<PrimaryRay> rays(count);
    for (PrimaryRay& ray : rays)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            ray.origin[axis] = low[axis] + (high[axis] - low[axis]) * uniform(random);
        }
        const float z = 2.0F * uniform(random) - 1.0F;
        const float angle = 2.0F * std::numbers::pi_v<float> * uniform(random);
        const float across = std::sqrt(1.0F - z * z);
        ray.direction = {across * std::cos(angle), across * std::sin(angle), z};
    }
    return rays;
}

} // namespace zvo::cli
