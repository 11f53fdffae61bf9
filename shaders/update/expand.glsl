// SPDX-License-Identifier: MIT
// The children of touched nodes of an overlay, and the sizes of what follows a level.
// Needs the constants kWideKeys, kEntriesPerWord, kAttributes, kRanks and kCarves, and the parameters of update/expand or
// update/top.
#ifndef ZVO_SHADERS_UPDATE_EXPAND_GLSL
#define ZVO_SHADERS_UPDATE_EXPAND_GLSL

#include "lib/brick_keys.glsl"
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"
#include "lib/ranks.glsl"
#include "update/update.h"

// The child of a touched node's base node, which must exist, in a cell. rank: of the base octree's node, where
// attributes need it; in an octree, the index of its attributes.
RankedNode baseChild(TouchedNode parent, uint cell, bool are_leaves)
{
    RankSource source = RankSource(Node_ConstPtr(uint64_t(params.nodes)), params.before, params.voxels_before_leaf,
                                   params.first_short_entry);
    RankedNode at = RankedNode(parent.base, 0u, 0u);
    if (kRanks)
    {
        BeforeChild rank = params.ranks.data[parent.node];
        at = RankedNode(parent.base, rank.voxels, rank.nodes);
    }
    descendBase(source, BeforeChild_ConstPtr(uint64_t(params.ranks)), cell, are_leaves, kRanks, at);
    return at;
}

// Whether the base tree is filled: only then, touched nodes need its attributes.
bool isFilled()
{
    bool filled = false;
    if (kEntriesPerWord == 0u && uint64_t(params.before) != 0ul)
        filled = uvec2_ConstPtr(uint64_t(params.before)).data[1].x != 0u;
    return filled;
}

// The attributes of such a child, which touched nodes have until they are averaged.
Attribute baseLook(TouchedNode parent, RankedNode base)
{
    if (kEntriesPerWord == 0u && isFullNode(base.node))
        return interiorLook(params.node_attributes.data[parent.node + params.attribute_offset]);
    bool is_behind = isBehind(params.static_root, base.node);
    return params.node_attributes.data[is_behind ? base.node + params.attribute_offset : base.rank];
}

// Gives a touched node its child base.
void setBase(uint node, uint base)
{
    params.nodes.data[node].base_lo = base;
    params.nodes.data[node].base_hi = base + bitCount(params.nodes.data[node].mask_lo);
}

// Whether layers cut a child of a touched node, or all of it.
bool isCut(uint entry, uint cell)
{
    bool is_cut = false;
    if (kCarves)
    {
        CarvedNode node = params.state.data[0].carved.data[entry];
        is_cut = hasCell(uvec2(node.cut_lo, node.cut_hi), cell);
    }
    return is_cut;
}

// What layers make of a touched node with the base tree's mask.
uvec2 mergedMask(uint entry, BrickEntry brick, uvec2 mask)
{
    mask |= uvec2(brick.mask_lo, brick.mask_hi);
    if (kCarves)
    {
        CarvedNode node = params.state.data[0].carved.data[entry];
        mask = uvec2(node.left_lo, node.left_hi);
    }
    return mask;
}

// Writes the child of a touched node in a cell, if there is one. Where a layer touches it, it is merged with the base
// tree's; others are copied from there. Returns how many children the overlay has to hold for it. child: its number.
// dag_leaves: the children are leaves, of a DAG.
uint expandChild(uint entry, uint cell, bool dag_leaves, out uint child)
{
    BrickEntry brick = params.bricks.data[entry];
    TouchedNode touched = params.touched.data[entry];
    Node node = params.nodes.data[touched.node];
    child = childIndex(node, cell);
    if (!hasChild(node, cell))
        return 0u;
    RankedNode base = RankedNode(kNoNode, 0u, 0u);
    if (touched.base != kNoNode)
    {
        if (hasCell(nodeMask(Node_ConstPtr(uint64_t(params.nodes)), touched.base), cell) && !isCut(entry, cell))
            base = baseChild(touched, cell, dag_leaves);
    }
    Node merged = Node(0u, 0u, 0u, 0u);
    uint64_t leaf_groups = kEntriesPerWord == 0u ? uint64_t(params.before) : 0ul;
    if (base.node != kNoNode)
        merged = loadCopyOf(Node_ConstPtr(uint64_t(params.nodes)), uvec2_ConstPtr(leaf_groups), base.node);
    if (kRanks)
        params.ranks.data[child] = BeforeChild(base.voxels, base.rank);
    uint count = 0u;
    if (hasCell(uvec2(brick.mask_lo, brick.mask_hi), cell))
    {
        BrickEntry child_brick;
        uint child_entry = brickFind(childKey(keyOf(brick), cell), child_brick);
        uvec2 mask = mergedMask(child_entry, child_brick, uvec2(merged.mask_lo, merged.mask_hi));
        merged.mask_lo = mask.x;
        merged.mask_hi = mask.y;
        params.touched.data[child_entry] = TouchedNode(child, base.node);
        count = bitCount(merged.mask_lo) + bitCount(merged.mask_hi);
    }
    else if (kRanks && dag_leaves) // written as an octree's leaf
    {
        merged.base_lo += base.voxels;
        merged.base_hi += base.voxels;
    }
    if (kAttributes && base.node != kNoNode && (count == 0u || isFilled()))
        params.node_attributes.data[child + params.attribute_offset] = baseLook(touched, base);
    params.counts.data[child - params.first_node] = count;
    params.nodes.data[child] = merged;
    return count;
}

// Sizes the level below one, or the leaves' voxels, from the number of its children, which may have wrapped around at
// 2^32: nothing if they find no room. By one thread. Returns whether they do.
bool sizeNextLevel(uint level, OverlayLevel span, uint children, bool wrapped)
{
    UpdateStatus status = params.state.data[0].status;
    DispatchArgs_Ptr args = params.state.data[0].args;
    uint level_count = params.state.data[0].level_count;
    uint max_groups_x = params.state.data[0].max_groups_x;
    wrapped = wrapped || status.node_count + children < children;
    bool are_leaves = level + 1u == level_count;
    status.node_count += are_leaves ? 0u : children;
    status.voxel_count = are_leaves ? children : 0u;
    bool too_many_nodes = status.node_count > params.state.data[0].node_capacity || (wrapped && !are_leaves);
    bool too_many_voxels = status.voxel_count > params.state.data[0].voxel_capacity || (wrapped && are_leaves);
    status.failed |= (too_many_nodes ? kFailedNodes : 0u) | (too_many_voxels ? kFailedVoxels : 0u);
    bool fits = status.failed == 0u;
    params.state.data[0].status.failed = status.failed;
    params.state.data[0].status.node_count = status.node_count;
    params.state.data[0].status.voxel_count = status.voxel_count;
    uint touched = fits ? params.ranges.data[level_count - 1u - level].count : 0u; // of this level
    if (are_leaves)
    {
        const uint leaves_per_group = kUpdateGroup / kMergeThreads;
        args.data[kArgsMerge] = foldedArgs((touched + leaves_per_group - 1u) / leaves_per_group, max_groups_x);
    }
    else
    {
        params.state.data[0].levels[level + 1u] =
            OverlayLevel(span.first_node + span.node_count, fits ? children : 0u);
        args.data[kArgsExpand] = foldedArgs(touched, max_groups_x);
    }
    uint block_count = touched == 0u ? 0u : (span.node_count + kScanBlock - 1u) / kScanBlock;
    args.data[kArgsAssign] = foldedArgs(block_count, max_groups_x);
    return fits;
}

#endif
