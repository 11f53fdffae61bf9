// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo
{

/// DAGs of tiles of a grid that become one DAG: equal nodes of different tiles, too, are stored once. Keeps them merged
/// now and then, so that memory is about that of the result.
class SvdagForest
{
public:
    /// Tiles are cubes of (1 << tile_depth)^3 voxels: whole nodes, so that tile_depth is even; it is less than
    /// grid.depth.
    SvdagForest(vk::HeadlessDevice& device, const Grid& grid, std::uint32_t tile_depth);

    /// Adds the DAG of the whole grid in which only one tile is occupied. code: the tile's Morton code among tiles,
    /// more than those before. Takes its nodes, not its attributes. Throws Error{Memory} when the device's budget does
    /// not suffice.
    void add(std::uint64_t code, DeviceTree dag);

    [[nodiscard]] bool isEmpty() const { return m_parts.empty(); }

    /// The DAG of all that was added; nothing is left here. Without attributes; with BeforeChild and so on if `ranks`.
    /// Throws as add().
    DeviceTree finish(bool ranks);

    /// Nodes above the tiles' roots, in all tiles' octree.
    [[nodiscard]] std::uint64_t topNodeCount() const;

    /// Of merging so far.
    [[nodiscard]] const std::vector<vk::PassTime>& passes() const { return m_passes; }

private:
    struct Tile
    {
        std::uint64_t code;
        std::uint32_t root; // node of its part's DAG
    };
    // One DAG with the tiles below it, ascending.
    struct Part
    {
        DeviceTree dag;
        std::vector<Tile> tiles;
    };

    void merge(bool ranks);
    [[nodiscard]] Part joined();
    void learnRoots(Part& part) const;

    vk::HeadlessDevice& m_device;
    Grid m_grid;
    std::size_t m_top_levels; // of nodes above the tiles' roots
    std::vector<Part> m_parts;
    std::vector<vk::PassTime> m_passes;
};

} // namespace zvo
