// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo::test
{

/// A node or a voxel as rays find it, without its index.
struct Cell
{
    std::uint32_t level = 0; // of a node; nodeLevels() for a voxel
    std::uint64_t code = 0;  // Morton code among the cells of its level
    gpu::Attribute attribute{};
    std::uint32_t emission = 0; // RGB9E5, or 0

    bool operator==(const Cell& other) const
    {
        return level == other.level && code == other.code && attribute.color == other.attribute.color &&
               attribute.normal == other.attribute.normal && emission == other.emission;
    }
};

/// Stands for the attributes of what is inside of a filled tree, and has none.
inline constexpr gpu::Attribute kInside{gpu::kAttributeNone << 24, gpu::kNoNormal};

/// Lists everything below nodes[0], level by level in Morton order. It follows bases and lists as the traversal does;
/// below lists, attributes are found by the ranks along the path. Attributes and emission are 0 if tree has none. Of a
/// filled tree, voxels without attributes and what is below full nodes have kInside.
/// Throws std::out_of_range if a reference leads out of a buffer.
std::vector<Cell> cellsOf(vk::HeadlessDevice& device, const DeviceTree& tree);

/// The octree of cells, listed as by cellsOf(), with their attributes and emission. It is made on the host, breadth
/// first.
DeviceTree octreeOf(vk::HeadlessDevice& device, const std::vector<Cell>& cells, const Grid& grid, float emission_scale);

/// Returns the first difference of two lists, or "".
std::string difference(const std::vector<Cell>& actual, const std::vector<Cell>& expected);

} // namespace zvo::test
