// SPDX-License-Identifier: MIT
// The least that can find what a ray hits, on the host: a bit a cell and no hierarchy.
#pragma once

#include "core/base/grid.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace zvo::baseline
{

/// What a ray hits first.
struct GridHit
{
    float t = 0.0F; // as far along the ray as the hit is, in lengths of its direction
    glm::uvec3 cell{0U};

    bool operator==(const GridHit&) const = default;
};

/// The voxels of a grid as bits, traced cell by cell (J. Amanatides, A. Woo, A Fast Voxel Traversal Algorithm for Ray
/// Tracing, 1987).
class BitGrid
{
public:
    static constexpr std::uint32_t kDepthMax = 11;

    /// codes: Morton codes of the voxels, in any order. Takes 8^depth bits; grid.depth must be at most kDepthMax.
    BitGrid(const Grid& grid, std::span<const std::uint64_t> codes);

    /// The first voxel that a ray enters from t_min on, in the space in which the octree's root cube is [1, 2)^3.
    /// Unlike the original, which adds up the times between planes, it computes the time of each plane from the plane,
    /// by zvo's rule (shaders/lib/traverse.glsl): so hits are zvo's, bit for bit, while no two planes of one axis are
    /// crossed at the same time. All numbers must be finite. Cost: cells along the ray.
    [[nodiscard]] std::optional<GridHit> firstHit(const glm::vec3& origin, const glm::vec3& direction,
                                                  float t_min) const;

private:
    [[nodiscard]] std::uint64_t bitOf(const glm::uvec3& cell) const
    {
        return ((std::uint64_t{cell.z} << m_depth | cell.y) << m_depth) | cell.x;
    }

    std::uint32_t m_depth;
    std::uint32_t m_root_resolution;
    std::vector<std::uint64_t> m_bits;
};

} // namespace zvo::baseline
