#version 460
// SPDX-License-Identifier: MIT
// Finds the children of nodes above bricks that are full. Between a full brick and an empty one stands one with a voxel
// that has attributes. So all bricks of a child without listed nodes are full if one of them is.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(AlgebraNodesParams, ALGEBRA_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "algebra/brick_masks.glsl"
#include "lib/cell_masks.glsl"
#include "lib/dispatch.glsl"

#define BRICKS_BINDING 0
#include "lib/bricks.glsl"

bool isFullBrick(uvec3 brick)
{
    BrickEntry found;
    uint entry = brickFind(brickKey(brick, params.brick_levels), found);
    if (entry != kNoEntry)
        return ((params.full.data[entry >> 5] >> (entry & 31u)) & 1u) != 0u;
    return isFullUnlisted(brick);
}

void main()
{
    LevelRange range = params.ranges.data[params.height];
    if (threadIndex() >= range.count)
        return;
    uint entry = params.items.data[range.first + threadIndex()].entry;
    BrickEntry node = loadBrick(entry);
    uvec3 corner = 4u * brickCell(keyOf(node), params.brick_levels - params.height);
    uvec2 full = uvec2(0u);
    for (uvec2 rest = ~uvec2(node.mask_lo, node.mask_hi); (rest.x | rest.y) != 0u;)
    {
        uint cell = firstCell(rest);
        rest &= ~cellBit(cell);
        if (isFullBrick((corner + cellNumbered(cell)) << (2u * params.height - 2u)))
            full |= cellBit(cell);
    }
    if ((full.x | full.y) == 0u)
        return;
    atomicOr(BRICK_WORD(entry, kMaskWord), full.x);
    atomicOr(BRICK_WORD(entry, kMaskWord + 1u), full.y);
    atomicAdd(params.counters.data[0].full_nodes[params.height - 1u], bitCount(full.x) + bitCount(full.y));
}
