#version 460
// SPDX-License-Identifier: MIT
// Writes the children of each touched node. Where a layer touches a child, it is merged with the base tree's; others
// are copied from there. A touched child stores how many children it will have.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#define BRICKS_CONSTANT_ID 0
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"

layout(constant_id = 1) const bool kAttributes = false;
layout(constant_id = 2) const uint kEntriesPerWord = 0u; // of the lists of a DAG, as base tree; 0: it is an octree
layout(constant_id = 3) const bool kLeaves = false; // the children are leaves, of a DAG

#include "lib/ranks.glsl"

const bool kLists = kEntriesPerWord != 0u;
const bool kRanks = kLists && kAttributes;

layout(local_size_x = kUpdateGroup) in;
layout(push_constant, scalar) uniform Push
{
    ExpandParams params;
};

uvec2 childKey(uvec2 key, uint cell)
{
    if (!kWideKeys)
        return uvec2((key.x << 6) | cell, 0u);
    uvec2 code = key & ~kBrickKeyTag;
    return uvec2(((code.x << 6) | cell) & ((1u << kBrickKeyBits) - 1u),
                 (code.y << 6) | (code.x >> (kBrickKeyBits - 6u))) |
           kBrickKeyTag;
}

// The child of a touched node's base node, which must exist, in a cell. rank: of the base octree's node, where
// attributes need it; in an octree, its number.
RankedNode baseChild(TouchedNode parent, uint cell)
{
    RankSource source = RankSource(Node_ConstPtr(uint64_t(params.nodes)), params.before, params.voxels_before_leaf,
                                   params.first_short_entry);
    RankedNode at = RankedNode(parent.base, 0u, 0u);
    if (kRanks)
    {
        BeforeChild rank = params.ranks.data[parent.node];
        at = RankedNode(parent.base, rank.voxels, rank.nodes);
    }
    descendBase(source, BeforeChild_ConstPtr(uint64_t(params.ranks)), cell, kLeaves, kRanks, at);
    return at;
}

void main()
{
    LevelRange range = params.ranges.data[params.item_range];
    uint item = workgroupIndex();
    if (item >= range.count)
        return;
    uint entry = params.items.data[range.first + item].entry;
    BrickEntry brick = params.bricks.data[entry];
    TouchedNode touched = params.touched.data[entry];
    Node node = params.nodes.data[touched.node];
    uint cell = gl_LocalInvocationIndex;
    if (!hasChild(node, cell))
        return;
    uint child = childIndex(node, cell);
    RankedNode base = RankedNode(kNoNode, 0u, 0u);
    if (touched.base != kNoNode)
    {
        Node base_node = params.nodes.data[touched.base];
        if (hasChild(base_node, cell))
            base = baseChild(touched, cell);
    }
    uint slot = child - params.first_node;
    Node merged = Node(0u, 0u, 0u, 0u);
    if (base.node != kNoNode)
        merged = params.nodes.data[base.node];
    if (kRanks)
        params.ranks.data[child] = BeforeChild(base.voxels, base.rank);
    if (((cell < 32u ? brick.mask_lo >> cell : brick.mask_hi >> (cell - 32u)) & 1u) != 0u)
    {
        uint child_entry = brickFind(params.bricks, params.brick_mask, childKey(keyOf(brick), cell));
        BrickEntry child_brick = params.bricks.data[child_entry];
        merged.mask_lo |= child_brick.mask_lo;
        merged.mask_hi |= child_brick.mask_hi;
        params.touched.data[child_entry] = TouchedNode(child, base.node);
        uint count = bitCount(merged.mask_lo) + bitCount(merged.mask_hi);
        params.counts.data[slot] = count;
        uint block = (child - params.levels.data[params.level].first_node) / kScanBlock;
        atomicAdd(params.partials.data[params.first_partial + block], count);
    }
    else
    {
        params.counts.data[slot] = 0u;
        if (kAttributes)
            params.node_attributes.data[child + params.attribute_offset] =
                params.node_attributes.data[base.node >= params.static_root ? base.node + params.attribute_offset
                                                                            : base.rank];
        if (kRanks && kLeaves) // written as an octree's leaf
        {
            merged.base_lo += base.voxels;
            merged.base_hi += base.voxels;
        }
    }
    params.nodes.data[child] = merged;
}
