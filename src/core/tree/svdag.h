// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/octree.h"
#include "core/tree/svdag_lists.h"
#include "shared/svdag.h"
#include "vk/buffer.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <vector>

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
    std::uint64_t entry_count = 0;              // of lists
    std::uint32_t entries_per_word = 2;         // of 64 bits; as many as ListPacking::tightest for what compress makes
    std::uint64_t long_entry_count = 0;         // of nodes above the parents of leaves
    vk::BufferOf<gpu::BeforeChild> before;      // [long_entry_count], or empty without attributes
    vk::BufferOf<gpu::uint> voxels_before_leaf; // [ceil((entry_count - long_entry_count) / 2)], likewise

    [[nodiscard]] ListPacking packing() const { return {tree.node_count, entry_count, entries_per_word}; }

    /// Bytes of nodes and lists; and of what stands beside the lists, so that voxels find their attributes.
    [[nodiscard]] std::uint64_t geometryBytes() const { return tree.geometryBytes() + packing().bytes(); }
    [[nodiscard]] std::uint64_t rankBytes() const { return before.bytes() + voxels_before_leaf.bytes(); }
};

/// What ranks in dag, which has attributes, are summed up from; pass reads it.
gpu::RankSource rankSource(vk::AnyPass& pass, const Svdag& dag);

/// The same, without declaring that anything reads it.
gpu::RankSource rankSource(const Svdag& dag);

} // namespace zvo
