#version 460
// SPDX-License-Identifier: MIT
// Lists, for each node above a filled layer's bricks, those of its children that no triangle may touch and that are
// inside, as voxelize/fill_nodes finds them.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(LayerNodesParams, UPDATE_LAYER_NODES_CONSTANTS);
layout(local_size_x = kUpdateGroup) in;

#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "voxelize/fill_columns.glsl"

// The level of a node's key, or that of bricks for other keys.
uint nodeLevel(uvec2 key)
{
    uint marked = kWideKeys ? key.y & kWideColumnTag : key.x & kColumnTag;
    uvec2 code = kWideKeys ? key & ~kBrickKeyTag : key;
    uint level = uint(kWideKeys && code.y != 0u ? int(kBrickKeyBits) + findMSB(code.y) : findMSB(code.x)) / 6u;
    return marked != 0u ? brickLevel() : level;
}

// Whether the column of cells below a brick's upper end is inside, down to the next brick.
bool isInside(uvec3 low)
{
    uvec3 column = uvec3(low.xz, 0u);
    int above = brickFrom(column, int(low.y));
    return above != kNoBrick && !isInColumn(column, kPartOpen, above);
}

void main()
{
    BinCounters bins = params.bins.data[0];
    if (threadIndex() > params.brick_mask || bins.fits == 0u || bins.overflow_count != 0u)
        return;
    BrickEntry node = params.bricks.data[threadIndex()];
    uint level = node.key != 0u ? nodeLevel(keyOf(node)) : brickLevel();
    if (level >= brickLevel())
        return;
    uint size_log2 = 2u * (brickLevel() - level) - 2u; // of a child, in bricks
    uvec3 corner = brickCell(keyOf(node), level) << 2; // in children
    uvec3 end = uvec3(gridResolution() >> int(kBrickLog2)) >> size_log2;
    uvec2 touched = uvec2(node.mask_lo, node.mask_hi);
    uvec2 full = uvec2(0u);
    bool is_known = false; // of the child above
    bool inside = false;
    for (uint i = 0u; i < kBrickLeaves; ++i)
    {
        uvec3 place = uvec3((i >> 2) & 3u, 3u - (i & 3u), i >> 4);
        uint cell = cellInBlock(place);
        bool asked = !hasCell(touched, cell) && all(lessThan(corner + place, end));
        is_known = is_known && (i & 3u) != 0u && asked;
        if (asked && !is_known)
            inside = isInside((corner + place) << size_log2);
        is_known = asked;
        if (asked && inside)
            full |= cell < 32u ? uvec2(1u << cell, 0u) : uvec2(0u, 1u << (cell & 31u));
    }
    if ((full.x | full.y) == 0u)
        return;
    uint number = atomicAdd(params.counters.data[0].leaf_count, 1u);
    if (number < params.leaf_capacity)
    {
        params.keys.data[number] = uvec2(node.key, kWideKeys ? node.base : 0u);
        params.nodes.data[params.brick_capacity + number] = Node(full.x, 0u, full.y, 0u);
    }
}
