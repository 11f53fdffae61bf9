// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree.h"
#include "shared/svdag.h"
#include "vk/buffer.h"

#include <cstdint>

namespace zvo
{

/// A sparse voxel DAG in device memory; shaders/shared/svdag.h documents its layout.
struct Svdag
{
    /// nodes: the pool, as many elements as it takes. node_count and levels: of the nodes in it. voxel_count,
    /// voxel_attributes and emission: of the octree. node_attributes: of all nodes of the octree, depth first, a node
    /// before its children, those in Morton order.
    Octree tree;

    std::uint32_t octree_node_count = 0;
    std::uint64_t entry_count = 0;              // words of lists
    std::uint64_t long_entry_count = 0;         // of nodes above the parents of leaves
    vk::BufferOf<gpu::BeforeChild> before;      // [long_entry_count], or empty without attributes
    vk::BufferOf<gpu::uint> voxels_before_leaf; // [ceil((entry_count - long_entry_count) / 2)], likewise

    [[nodiscard]] std::uint64_t geometryBytes() const
    {
        return tree.geometryBytes() + entry_count * sizeof(gpu::uint) + before.bytes() + voxels_before_leaf.bytes();
    }
};

} // namespace zvo
