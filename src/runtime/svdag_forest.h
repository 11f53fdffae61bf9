// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo
{

/// Merges the DAGs of the tiles of a grid into one DAG, in which equal nodes of different tiles are stored once, too.
/// Merges now and then while tiles are added, so that the memory it needs is about that of the result.
class SvdagForest
{
public:
    /// tile_depth: tiles are cubes of (1 << tile_depth)^3 voxels. It must be even, as tiles consist of whole nodes, at
    /// least 4, and less than grid.depth.
    SvdagForest(vk::HeadlessDevice& device, const Grid& grid, std::uint32_t tile_depth);

    /// Adds the DAG of the whole grid in which only one tile has voxels. code: the tile's Morton code among the tiles;
    /// it must be greater than those before. dag: without attributes. Throws Error{Memory} when the device's budget
    /// does not suffice.
    void add(std::uint64_t code, DeviceTree dag);

    [[nodiscard]] bool isEmpty() const { return m_parts.empty(); }

    /// Returns the DAG of all tiles, without attributes, and leaves the forest empty. ranks: whether the DAG gets
    /// ChildLists::before and voxels_before_leaf. Throws as add().
    DeviceTree finish(bool ranks);

    /// Number of nodes above the roots of the tiles in the octree of all tiles.
    [[nodiscard]] std::uint64_t topNodeCount() const { return top().nodes.size(); }

    /// Times of the passes that have merged tiles so far.
    [[nodiscard]] const std::vector<vk::PassTime>& passes() const { return m_passes; }

private:
    struct Tile
    {
        std::uint64_t code;
        std::uint32_t root; // node in the DAG of the tile's part
    };
    // A DAG and the tiles that it contains, by ascending code.
    struct Part
    {
        DeviceTree dag;
        std::vector<Tile> tiles;
    };

    [[nodiscard]] TreeData top() const;
    void merge(bool ranks);
    [[nodiscard]] Part joined();
    void learnRoots(Part& part) const;

    vk::HeadlessDevice& m_device;
    Grid m_grid;
    std::uint32_t m_tile_depth;
    std::size_t m_top_levels; // levels of nodes above the tiles' roots
    std::vector<Part> m_parts;
    std::vector<vk::PassTime> m_passes;
};

} // namespace zvo
