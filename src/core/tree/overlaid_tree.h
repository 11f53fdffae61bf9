// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/svdag.h"
#include "shared/svdag.h"
#include "vk/buffer.h"

#include <cstdint>

namespace zvo
{

/// A static octree or DAG in buffers that have room for overlays of dynamic update (shaders/update/update.h) behind it.
struct OverlaidTree
{
    /// Without levels. nodes: a slot for the root that is traced, the other static nodes and lists, the static root,
    /// then overlays. node_attributes: those of the slot, of the other nodes of the static octree, of the static root,
    /// then of overlays. Counts are those of the static part: 1 node for an empty one. An octree has no lists.
    Svdag dag;

    bool has_lists = false;        // a DAG
    std::uint32_t static_root = 0; // behind the static nodes and lists

    /// Of the nodes behind static_root: the rank of the static octree's node in the same place, 0 where it has none.
    /// Only of a DAG with attributes.
    vk::BufferOf<gpu::BeforeChild> ranks;

    [[nodiscard]] bool hasRanks() const { return ranks.count() != 0; }
    [[nodiscard]] bool hasAttributes() const { return dag.tree.node_attributes.count() != 0; }

    /// From the number of static_root, or of a node behind it, to the index of its attributes, modulo 2^32.
    [[nodiscard]] std::uint32_t attributeOffset() const { return dag.octree_node_count - static_root; }

    /// Where ranks would begin if it had elements for all nodes.
    [[nodiscard]] std::uint64_t ranksSkipped() const
    {
        return (std::uint64_t{static_root} + 1) * sizeof(gpu::BeforeChild);
    }
};

} // namespace zvo
