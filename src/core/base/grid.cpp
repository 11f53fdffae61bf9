// SPDX-License-Identifier: MIT
#include "core/base/grid.h"

#include "zvo/error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace zvo
{

namespace
{

constexpr double kFloatMax = std::numeric_limits<float>::max();

/// Below it 256 / voxel_size, the scale of the lattice, comes close to the end of single precision.
constexpr double kVoxelSizeMin = 1e-35;

/// Stays within single precision: so does what the box encloses.
float roundDown(double value)
{
    const double clamped = std::clamp(value, -kFloatMax, kFloatMax);
    const auto nearest = static_cast<float>(clamped);
    return static_cast<double>(nearest) <= clamped ? nearest : std::nextafter(nearest, -INFINITY);
}

float roundUp(double value)
{
    return -roundDown(-value);
}

double longestEdge(const glm::dvec3& extent)
{
    return std::max({extent.x, extent.y, extent.z});
}

/// The cube from corner on that reaches high on every axis. The corner is rounded down and the voxel size up, so that
/// the box stays inside; the corner's rounding makes the cube longer by no more than itself.
Grid cubeFrom(const glm::dvec3& corner, const glm::dvec3& high, double edge, std::uint32_t depth)
{
    Grid grid;
    grid.depth = depth;
    grid.origin = {roundDown(corner.x), roundDown(corner.y), roundDown(corner.z)};
    const double needed = std::max(edge, longestEdge(high - glm::dvec3(grid.origin)));
    grid.voxel_size = roundUp(std::max(needed / grid.resolution(), kVoxelSizeMin));
    return grid;
}

} // namespace

Grid Grid::around(const Bounds& bounds, std::uint32_t depth, std::uint32_t margin)
{
    assert(depth >= 1 && depth <= kDepthMax && 2 * margin < 1U << depth);
    const glm::dvec3 low = bounds.empty() ? glm::dvec3(0.0) : glm::dvec3(bounds.min);
    const glm::dvec3 high = bounds.empty() ? glm::dvec3(0.0) : glm::dvec3(bounds.max);
    const double longest = longestEdge(high - low);
    const double resolution = 1U << depth;
    const double edge = (longest > 0.0 ? longest : 1.0) * resolution / (resolution - 2.0 * margin);
    const glm::dvec3 corner = 0.5 * (low + high) - 0.5 * edge;
    return cubeFrom(glm::min(corner, low), high, edge, depth);
}

Grid Grid::withCorner(const Bounds& bounds, std::uint32_t depth)
{
    assert(depth >= 1 && depth <= kDepthMax);
    if (bounds.empty())
    {
        throw Error(ErrorCode::Usage,
                    "the grid cannot be placed: there is nothing to enclose; give it a scene with triangles");
    }
    const glm::dvec3 low(bounds.min);
    const glm::dvec3 high(bounds.max);
    const double longest = longestEdge(high - low);
    return cubeFrom(low, high, longest > 0.0 ? longest : 1.0, depth);
}

} // namespace zvo
