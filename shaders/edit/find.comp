#version 460
// SPDX-License-Identifier: MIT
// Finds the base tree's node of each cell, and what the brush does to the leaves among them.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"
#include "edit/cells.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

layout(constant_id = 0) const uint kEntriesPerWord = 0u; // of the lists of a DAG; 0: the static tree is an octree
layout(constant_id = 1) const bool kAttributes = false;

#include "lib/ranks.glsl"

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    EditFindParams params;
};

const bool kRanks = kEntriesPerWord != 0u && kAttributes;

// The base tree's node of a cell, or kNoEditNode.
RankedNode baseNode(uint level, uvec3 cell)
{
    RankSource source =
        RankSource(params.nodes, params.before, params.voxels_before_leaf, params.first_short_entry);
    RankedNode at = RankedNode(params.slots.region_node + params.slots.from, 0u, 0u);
    for (uint l = 0u; l < level && at.node != kNoEditNode; ++l)
    {
        uint child = cellInBlock(cell >> (2u * (level - 1u - l)));
        bool exists = hasChild(params.nodes.data[at.node], child);
        if (exists)
            descendBase(source, params.ranks, child, l + 2u == params.box.level_count, kRanks, at);
        at.node = exists ? at.node : kNoEditNode;
    }
    return at;
}

// Computes the leaf's mask after the dab, and whether the mask or a voxel changes.
void dab(Node base, uvec3 leaf, inout EditCell cell)
{
    uvec2 mask = uvec2(base.mask_lo, base.mask_hi);
    uvec2 under = uvec2(0u);
    for (uint bit = 0u; bit < 64u; ++bit)
    {
        uvec3 voxel = 4u * leaf + cellAt(bit);
        bool covered = isInBox(params.box, params.box.level_count, voxel) && isUnderBrush(params.brush, voxel);
        under.x |= covered && bit < 32u ? 1u << bit : 0u;
        under.y |= covered && bit >= 32u ? 1u << (bit - 32u) : 0u;
    }
    uvec2 made = params.brush.action == kBrushFill ? under & ~mask : uvec2(0u);
    uvec2 taken = params.brush.action == kBrushCarve ? under & mask : uvec2(0u);
    uvec2 painted = params.brush.action == kBrushPaint && kAttributes ? under & mask : uvec2(0u);
    uvec2 touched = made | taken | painted;
    cell.mask_lo = (mask.x | made.x) & ~taken.x;
    cell.mask_hi = (mask.y | made.y) & ~taken.y;
    cell.changed = (touched.x | touched.y) != 0u ? 1u : 0u;
    uint more = bitCount(made.x) + bitCount(made.y) - bitCount(taken.x) - bitCount(taken.y);
    if (more != 0u)
        atomicAdd(params.states.data[params.slots.to].voxel_count, more); // cleared
}

void main()
{
    uint index = threadIndex();
    uint number = index;
    uint level = levelOf(params.box, number);
    if (level == params.box.level_count)
        return;
    uvec3 position = cellOf(params.box, level, number);
    RankedNode at = baseNode(level, position);
    Node base = Node(0u, 0u, 0u, 0u);
    if (at.node != kNoEditNode)
        base = params.nodes.data[at.node];
    EditCell cell = EditCell(at.node, at.voxels, at.rank, base.mask_lo, base.mask_hi, 0u, 0u, 0u);
    if (level + 1u == params.box.level_count)
        dab(base, position, cell);
    params.cells.data[index] = cell;
}
