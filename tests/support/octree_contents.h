// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo::test
{

/// A node or a voxel as a ray sees it, whatever its number.
struct Cell
{
    std::uint32_t level = 0; // of nodes; nodeLevels() for a voxel
    std::uint64_t code = 0;  // Morton code among the cells of its level
    gpu::Attribute attribute{};
    std::uint32_t emission = 0; // RGB9E5, or 0

    bool operator==(const Cell& other) const
    {
        return level == other.level && code == other.code && attribute.color == other.attribute.color &&
               attribute.normal == other.attribute.normal && emission == other.emission;
    }
};

/// Everything below nodes[0], level by level in Morton order, by following the bases, and lists, as the traversal does;
/// below lists, ranks along the path tell which attributes are whose. Attributes and emission are 0 where tree has
/// none. Throws std::out_of_range where something leads out of a buffer.
std::vector<Cell> cellsOf(vk::HeadlessDevice& device, const DeviceTree& tree);

/// The octree of cells as cellsOf() lists them, in device memory, breadth first, with attributes and emission if that
/// is asked for.
DeviceTree octreeOf(vk::HeadlessDevice& device, const std::vector<Cell>& cells, const Grid& grid, bool attributes,
                    float emission_scale);

/// An octree of cells as cellsOf() lists them, with their attributes and emission: breadth first, made on the host.
DeviceTree octreeOf(vk::HeadlessDevice& device, const std::vector<Cell>& cells, const Grid& grid, float emission_scale);

/// What tells two lists apart: the first difference, or "" for none.
std::string difference(const std::vector<Cell>& actual, const std::vector<Cell>& expected);

} // namespace zvo::test
