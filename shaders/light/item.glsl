// SPDX-License-Identifier: MIT
// Goes down the voxel tree from a node under construction (light/light_tree.h).
// Needs the constants kNodeLevels and kEntriesPerWord, and params.tree.
#ifndef ZVO_SHADERS_LIGHT_ITEM_GLSL
#define ZVO_SHADERS_LIGHT_ITEM_GLSL

#include "lib/node.glsl"
#include "lib/ranks.glsl"
#include "shared/tree_table.h"

const bool kRanked = kEntriesPerWord != 0u; // voxels and nodes of a DAG have attributes by ranks

// The voxel tree.
Node loadNode(uint reference)
{
    uint64_t leaf_groups = kEntriesPerWord == 0u ? uint64_t(params.tree.data[0].source.before) : 0ul;
    return loadNodeOf(Node_ConstPtr(uint64_t(params.tree.data[0].source.pool)), uvec2_ConstPtr(leaf_groups), reference);
}

// A leaf of it, with the voxels that have attributes.
Node loadLeaf(uint reference)
{
    if (isFilledDag(kEntriesPerWord) && !isLeafWord(reference))
        return Node(0u, 0u, 0u, 0u); // a full node
    reference += isFilledDag(kEntriesPerWord) ? 1u : 0u;
    uint64_t leaf_groups = kEntriesPerWord == 0u ? uint64_t(params.tree.data[0].source.before) : 0ul;
    return loadSurfaceOf(Node_ConstPtr(uint64_t(params.tree.data[0].source.pool)), uvec2_ConstPtr(leaf_groups),
                         reference);
}

RankSource rankSourceOfTree()
{
    TreeTable_ConstPtr tree = params.tree;
    return RankSource(Node_ConstPtr(uint64_t(tree.data[0].source.pool)),
                      BeforeChild_ConstPtr(uint64_t(tree.data[0].source.before)),
                      uint_ConstPtr(uint64_t(tree.data[0].source.voxels_before_leaf)),
                      tree.data[0].source.first_short_entry);
}

// The lowest, or else the highest, occupied cell of a node.
uint outermostCell(Node node, bool lowest)
{
    uint low = node.mask_lo != 0u && (lowest || node.mask_hi == 0u) ? node.mask_lo : 0u;
    uint mask = low != 0u ? low : node.mask_hi;
    return uint(lowest ? findLSB(mask) : findMSB(mask)) + (low != 0u ? 0u : 32u);
}

// The child of a node in a cell, which must exist. direct: the child is not named by a list, as in an octree.
RankedNode childOf(RankedNode at, uint cell, bool to_leaf, out bool direct)
{
    direct = (childIndex(loadNode(at.node), cell) & kChildList) == 0u;
    descendBase(rankSourceOfTree(), BeforeChild_ConstPtr(uint64_t(params.tree.data[0].overlay_ranks)), cell, to_leaf,
                kRanked, at);
    // Leaves of overlays have the indices of attributes, other leaves of a DAG the numbers within the leaf.
    if (kRanked && to_leaf && direct)
        at.voxels = 0u;
    return at;
}

// The first, or else the last, voxel below a node of a level.
uint outermostVoxel(RankedNode at, uint level, bool first)
{
    bool direct;
    for (uint below = level; below + 1u < kNodeLevels; ++below)
        at = childOf(at, outermostCell(loadNode(at.node), first), below + 2u == kNodeLevels,
                     direct);
    Node leaf = loadLeaf(at.node);
    return childIndex(leaf, outermostCell(leaf, first)) + at.voxels;
}

#endif
