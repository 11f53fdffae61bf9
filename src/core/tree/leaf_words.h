// SPDX-License-Identifier: MIT
// Between the nodes and lists of a TreeData, whose leaves are nodes, and a pool in device memory, whose leaves are leaf
// words (shaders/shared/octree.h).
#pragma once

#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// What a tree's nodes and lists are in device memory.
struct TreePool
{
    std::vector<gpu::Node> nodes;        // as DeviceTree::nodes
    std::vector<gpu::uvec2> leaf_groups; // as DeviceTree::leaf_groups
    std::uint32_t leaf_words = 0;
    std::uint32_t entries_per_word = 2;
};

/// The number of the leaf words of a tree with levels: all leaves, unless the root is one.
inline std::uint32_t leafWordsOf(std::span<const DeviceTree::Level> levels)
{
    return levels.size() > 1 ? levels.back().node_count : 0;
}

/// The node from which full nodes stand in the pool of a filled tree, then surface masks (shaders/shared/octree.h).
std::uint32_t firstFullNode(std::uint64_t inner_count, std::uint64_t leaf_count);

/// Nodes of the pool of an octree, without room for overlays.
std::uint64_t poolNodes(std::uint64_t inner_count, std::uint64_t leaf_count, bool filled);

/// Element 0 of the leaf groups of an octree (shaders/shared/octree.h).
gpu::uvec2 firstLeafGroup(std::uint64_t inner_count, std::uint64_t leaf_count, bool filled);

/// The pool of a tree that checkTree accepts: voxels are numbered in the order of the leaves.
TreePool poolOf(const TreeData& tree);

/// Appends leaves to the inner nodes of a tree. masks: of the leaves in their order.
void appendLeaves(std::span<const std::uint64_t> masks, TreeData& tree);

/// Sets the nodes and lists of a tree from the pool of `from`, whose levels and numbers it has.
void setNodes(std::span<const gpu::Node> pool, const DeviceTree& from, TreeData& tree);

} // namespace zvo
