// SPDX-License-Identifier: MIT
#include "stress/stress_rays.h"

#include "oracle/morton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zvo::stress
{

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kFar = 1e5F;     // units
constexpr float kFarFrom = 2e3F; // from here on, planes coincide by rounding
constexpr std::uint32_t kInvalidEvery = 16;

std::uint32_t below(Random& random, std::uint32_t end)
{
    return static_cast<std::uint32_t>((random() >> 32) * end >> 32);
}

float uniform(Random& random, float low, float high)
{
    return low + (high - low) * (static_cast<float>(random() >> 40) * 0x1p-24F);
}

glm::vec3 uniformPoint(Random& random, float low, float high)
{
    const float x = uniform(random, low, high);
    const float y = uniform(random, low, high);
    return {x, y, uniform(random, low, high)};
}

glm::vec3 anyDirection(Random& random)
{
    for (;;)
    {
        const glm::vec3 v = uniformPoint(random, -1.0F, 1.0F);
        const float length = glm::length(v);
        if (length <= 1.0F && length > 0.01F)
        {
            return v / length;
        }
    }
}

// A direction with whole components from -range to range, zeros of both signs among them, not all zero.
glm::vec3 wholeDirection(Random& random, std::uint32_t range)
{
    glm::vec3 direction(0.0F);
    while (direction == glm::vec3(0.0F))
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            const float size = static_cast<float>(below(random, range + 1));
            direction[axis] = std::copysign(size, below(random, 2) == 0 ? 1.0F : -1.0F);
        }
    }
    return direction;
}

StressRay finished(Random& random, const glm::vec3& origin, const glm::vec3& direction)
{
    StressRay ray;
    const std::uint32_t kind = below(random, 16);
    const float reach =
        1.0F / std::max({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z), 1e-30F});
    const float t_min = kind == 0 ? uniform(random, 0.0F, reach) : kind == 1 ? -1.0F : 0.0F;
    ray.ray = oracle::makeRay(origin, direction, std::max(t_min, gpu::kTraceTimeMin));
    ray.t_max = kind == 2 ? uniform(random, 0.0F, reach) : kInfinity;
    ray.device = {ray.ray.origin, t_min, ray.ray.inv, ray.t_max};
    ray.far = glm::length(origin) > kFarFrom;
    return ray;
}

void spoil(Random& random, StressRay& ray)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const float bad[] = {kNan, kInfinity, -kInfinity, 0.0F, -0.0F, 1e-40F};
    const int axis = static_cast<int>(below(random, 3));
    ray.invalid = true;
    switch (below(random, 4))
    {
    case 0:
        ray.device.origin[axis] = bad[below(random, 3)];
        break;
    case 1:
        ray.device.inverse_direction[axis] = bad[below(random, 6)];
        break;
    case 2:
        ray.device.t_min = bad[below(random, 3)];
        break;
    default:
        ray.device.t_max = below(random, 2) == 0 ? kNan : -1.0F;
        break;
    }
}

} // namespace

StressRay randomRay(Random& random)
{
    const glm::vec3 direction = anyDirection(random) * std::exp2(uniform(random, -8.0F, 8.0F));
    switch (below(random, 4))
    {
    case 0:
        return finished(random, uniformPoint(random, 1.0F, 2.0F), direction);
    case 1:
        return finished(random, uniformPoint(random, 0.0F, 3.0F), direction);
    default:
    {
        const glm::vec3 origin =
            uniformPoint(random, 1.0F, 2.0F) - anyDirection(random) * std::pow(10.0F, uniform(random, 0.0F, 5.0F));
        return finished(random, origin, uniformPoint(random, 1.0F, 2.0F) - origin);
    }
    }
}

StressRay aimedRay(Random& random, std::uint32_t resolution, const test::Codes& codes)
{
    const float edge = 1.0F / static_cast<float>(resolution);
    const glm::vec3 voxel(oracle::mortonDecode(codes[random() % codes.size()]));
    glm::vec3 corner(0.0F);
    for (int axis = 0; axis < 3; ++axis)
    {
        corner[axis] = static_cast<float>(below(random, 2));
    }
    if (below(random, 2) == 0) // a point on an edge
    {
        corner[static_cast<int>(below(random, 3))] = uniform(random, 0.0F, 1.0F);
    }
    const glm::vec3 target = 1.0F + edge * (voxel + corner);
    const glm::vec3 inside = 1.0F + edge * (voxel + uniformPoint(random, -1.0F, 2.0F));
    glm::vec3 lattice(0.0F);
    for (int axis = 0; axis < 3; ++axis)
    {
        lattice[axis] = 1.0F + edge * (static_cast<float>(below(random, resolution + 5)) - 2.0F);
    }
    glm::vec3 origin = uniformPoint(random, 0.5F, 2.5F);
    glm::vec3 direction = target - origin;
    switch (below(random, 12))
    {
    case 0: // from anywhere
        break;
    case 1: // from a corner
        origin = lattice;
        direction = target - origin;
        break;
    case 2: // from far away
        origin = target - anyDirection(random) * kFar;
        direction = target - origin;
        break;
    case 3:
        origin = target - anyDirection(random) * kFar * edge;
        direction = target - origin;
        break;
    case 4: // in an edge, from a distance that may be a whole number
        direction = glm::vec3(0.0F);
        direction[static_cast<int>(below(random, 3))] = below(random, 2) == 0 ? 1.0F : -1.0F;
        direction *= std::exp2(static_cast<float>(below(random, 5)) - 2.0F);
        origin = target - direction * (below(random, 2) == 0 ? 1.0F : uniform(random, 0.0F, 2.0F));
        for (int axis = 0; axis < 3; ++axis)
        {
            direction[axis] = direction[axis] == 0.0F && below(random, 2) == 0 ? -0.0F : direction[axis];
        }
        break;
    case 5: // in a plane
    {
        const int axis = static_cast<int>(below(random, 3));
        origin[axis] = target[axis];
        direction[axis] = below(random, 2) == 0 ? 0.0F : -0.0F;
        break;
    }
    case 6: // in directions with exact ties
        direction = wholeDirection(random, 1);
        origin = target - direction * edge * static_cast<float>(below(random, 2 * resolution));
        break;
    case 7:
        direction = wholeDirection(random, 5);
        origin = target - direction * edge * static_cast<float>(below(random, resolution));
        break;
    case 8: // from inside of a voxel
        origin = inside;
        direction = below(random, 2) == 0 ? anyDirection(random) : target - origin;
        break;
    case 9: // almost parallel to a plane
        direction[static_cast<int>(below(random, 3))] *= below(random, 2) == 0 ? 1e-6F : 1e-19F;
        origin = target - direction;
        break;
    case 10: // long and short directions
        direction *= std::exp2(uniform(random, -40.0F, 60.0F));
        break;
    default: // from the middle of a voxel in directions with ties
        origin = 1.0F + edge * (voxel + 0.5F);
        direction = wholeDirection(random, 3);
        origin -= direction * edge * static_cast<float>(below(random, resolution));
        break;
    }
    StressRay ray = finished(random, origin, direction);
    if (below(random, kInvalidEvery) == 0)
    {
        spoil(random, ray);
    }
    return ray;
}

StressRay rayFromInside(Random& random, std::uint32_t resolution, const glm::vec3& low, const glm::vec3& high)
{
    const float edge = 1.0F / static_cast<float>(resolution);
    const std::uint32_t kind = below(random, 3);
    glm::vec3 origin(0.0F);
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto first = static_cast<std::uint32_t>(low[axis]);
        const auto count = static_cast<std::uint32_t>(high[axis]) - first;
        const float offset = kind == 0 ? 0.0F : kind == 1 ? 0.5F : uniform(random, 0.0F, 1.0F);
        origin[axis] = 1.0F + edge * (static_cast<float>(first + below(random, count)) + offset);
    }
    const glm::vec3 direction = below(random, 2) == 0 ? anyDirection(random) : wholeDirection(random, 4);
    StressRay ray;
    ray.ray = oracle::makeRay(origin, direction, gpu::kTraceTimeMin);
    ray.t_max = kInfinity;
    ray.device = {ray.ray.origin, 0.0F, ray.ray.inv, kInfinity};
    return ray;
}

} // namespace zvo::stress
