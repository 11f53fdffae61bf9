// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo
{

/// Axis-aligned box in world space; empty while min > max.
struct Bounds
{
    glm::vec3 min{INFINITY};
    glm::vec3 max{-INFINITY};

    [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    void extend(const glm::vec3& point)
    {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
};

/// Bits of a Morton code that select one of the 4^3 children of a node.
inline constexpr std::uint32_t kCellBits = 6;

/// A cube of (1 << depth)^3 voxels. Voxel (x, y, z) is the box of edge voxel_size whose minimum corner is origin +
/// voxel_size * (x, y, z). Both members are single precision: printed with nine digits they are read back bit for bit.
struct Grid
{
    glm::vec3 origin{0.0F};  // world position of the minimum corner
    float voxel_size = 1.0F; // world units
    std::uint32_t depth = 1; // 1 to kDepthMax

    static constexpr std::uint32_t kDepthMax = 17;

    [[nodiscard]] std::uint32_t resolution() const { return 1U << depth; }

    /// Levels of octree nodes. A node spans two octree levels; where the depth is odd, the root spans only one.
    [[nodiscard]] std::uint32_t nodeLevels() const { return (depth + 1) / 2; }

    /// Voxels per edge of the cube that the root node covers, 4^nodeLevels(): the resolution, or twice that for an odd
    /// depth.
    [[nodiscard]] std::uint32_t rootResolution() const { return 1U << (2 * nodeLevels()); }

    /// The smallest cube around bounds, centred on it, with `margin` free voxels at each side, below half of the
    /// resolution. Empty bounds or a single point are taken to have an edge of 1.
    static Grid around(const Bounds& bounds, std::uint32_t depth, std::uint32_t margin = 0);

    /// The cube with bounds' minimum corner and the length of its longest edge. Throws Error{Usage} for empty bounds.
    static Grid withCorner(const Bounds& bounds, std::uint32_t depth);

    bool operator==(const Grid&) const = default;
};

/// A cube of (1 << depth)^3 voxels of a grid, or the whole grid. The grid is divided into such cubes; `index` numbers
/// them along x, y and z.
struct GridTile
{
    /// Implicit conversion: the tile that is the whole grid.
    GridTile(const Grid& whole) : grid(whole), depth(whole.depth) {}

    /// tile_index: each component below 1 << (grid.depth - tile_depth), and below kTilesMax.
    GridTile(const Grid& whole, std::uint32_t tile_depth, const glm::uvec3& tile_index)
        : grid(whole), depth(tile_depth), index(tile_index)
    {
    }

    static constexpr std::uint32_t kTilesMax = 128;

    Grid grid;
    std::uint32_t depth;
    glm::uvec3 index{0};
};

} // namespace zvo
