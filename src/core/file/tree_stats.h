// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// The sizes that the same voxels would have in trees whose nodes have 2x2x2 cells (binary trees below), as octree and
/// as DAG.
struct TreeStats
{
    /// Bytes of a binary octree's node with a mask and eight 32-bit numbers of children.
    static constexpr std::uint64_t kSlidesOctreeNodeBytes = 36;

    /// Bytes of a binary DAG's node that also has eight counts of voxels.
    static constexpr std::uint64_t kSlidesDagNodeBytes = 68;

    std::vector<std::uint64_t>
        unique_per_level;                  // number of different subtrees in each level of nodes, the root's first
    std::uint64_t binary_node_count = 0;   // inner nodes of the binary octree; voxels are bits of the lowest ones
    std::uint64_t binary_unique_count = 0; // different ones among them: the nodes of the binary DAG

    [[nodiscard]] std::uint64_t slidesOctreeBytes() const { return binary_node_count * kSlidesOctreeNodeBytes; }
    [[nodiscard]] std::uint64_t slidesDagBytes() const { return binary_unique_count * kSlidesDagNodeBytes; }
};

/// Counts these sizes for a tree that checkTree accepts. An octree and its DAG give the same results. Nothing is
/// expanded; memory: about 30 bytes for each node of the largest level.
TreeStats treeStats(const TreeData& tree);

} // namespace zvo
