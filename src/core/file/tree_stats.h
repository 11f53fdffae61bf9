// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// What the same voxels come to in the trees of others, whose nodes have 2x2x2 cells, and what a DAG of them needs.
struct TreeStats
{
    /// Bytes of a binary octree's node with a mask and eight 32-bit numbers of children.
    static constexpr std::uint64_t kSlidesOctreeNodeBytes = 36;

    /// Bytes of a binary DAG's node that also has eight counts of voxels.
    static constexpr std::uint64_t kSlidesDagNodeBytes = 68;

    std::vector<std::uint64_t> unique_per_level; // different subtrees of each level of nodes, the root's first
    std::uint64_t binary_node_count = 0;         // inner nodes of the binary octree; voxels are bits of the lowest ones
    std::uint64_t binary_unique_count = 0;       // the different ones among them: nodes of the binary DAG

    [[nodiscard]] std::uint64_t slidesOctreeBytes() const { return binary_node_count * kSlidesOctreeNodeBytes; }
    [[nodiscard]] std::uint64_t slidesDagBytes() const { return binary_unique_count * kSlidesDagNodeBytes; }
};

/// Counts in a tree that checkTree accepts, an octree or a DAG: the results are the same. Nothing is expanded; memory:
/// about 30 bytes a node of the largest level.
TreeStats treeStats(const TreeData& tree);

} // namespace zvo
