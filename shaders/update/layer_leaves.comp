#version 460
// SPDX-License-Identifier: MIT
// Lists the leaves in a layer's brick table and gives each room for its voxels' sums. Their order is arbitrary, as sums
// do not depend on it. If a leaf has no room, its voxels are dropped, so that nothing is written past the end; the
// layer cannot be used then.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#define BRICKS_CONSTANT_ID 0
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "lib/found_bricks.glsl"

layout(local_size_x = kCollectGroup) in;
layout(push_constant, scalar) uniform Push
{
    LayerLeavesParams params;
};

void main()
{
    FoundBricks found = findBricks(BrickEntry_ConstPtr(params.bricks), params.brick_capacity);
    uvec2 first = uvec2(0u); // leaf and voxel
    if (subgroupElect() && found.total.x != 0u)
    {
        first.x = atomicAdd(params.counters.data[0].leaf_count, found.total.x);
        first.y = atomicAdd(params.counters.data[0].voxel_count, found.total.y);
    }
    first = subgroupBroadcastFirst(first) + found.before;
    for (; found.occupied != 0u;)
    {
        uint entry = takeBrick(found);
        BrickEntry brick = params.bricks.data[entry];
        uint middle = first.y + bitCount(brick.mask_lo);
        uint end = middle + bitCount(brick.mask_hi);
        bool has_slot = first.x < params.leaf_capacity;
        bool fits = has_slot && end <= params.voxel_capacity && end >= first.y;
        if (has_slot)
        {
            params.keys.data[first.x] = keyOf(brick);
            params.leaves.data[first.x] =
                fits ? Node(brick.mask_lo, first.y, brick.mask_hi, middle) : Node(0u, 0u, 0u, 0u);
        }
        if (!fits)
            params.bricks.data[entry].mask_hi = 0u;
        if (kWideKeys || !fits) // wide: the leaf's number
            params.bricks.data[entry].mask_lo = kWideKeys && has_slot ? first.x : 0u;
        if (!kWideKeys)
            params.bricks.data[entry].base = fits ? first.y : 0u;
        else if (!has_slot) // half a key, which is never found
            params.bricks.data[entry].base = 0u;
        ++first.x;
        first.y = end;
    }
}
