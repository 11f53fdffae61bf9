#version 460
// SPDX-License-Identifier: MIT
// Every node of a level sets its bit in its parent, which the first of its children puts into the table and the list.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#define BRICKS_CONSTANT_ID 0
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    ParentsParams params;
};

void main()
{
    LevelRange range = params.ranges.data[params.height];
    uint item = threadIndex();
    if (item >= range.count)
        return;
    item += range.first;
    uvec2 key = keyOf(params.bricks.data[params.items.data[item].entry]);
    bool claimed;
    uint parent = brickFindOrInsert(params.bricks, params.brick_mask, parentKey(key), claimed);
    if (parent == kNoEntry)
    {
        atomicAdd(params.counters.data[0].overflow_count, 1u);
        return;
    }
    uint bit = 1u << (key.x & 31u);
    if ((key.x & 32u) == 0u)
        atomicOr(params.bricks.data[parent].mask_lo, bit);
    else
        atomicOr(params.bricks.data[parent].mask_hi, bit);
    params.items.data[item].parent_entry = parent;
    if (claimed)
        params.items.data[atomicAdd(params.counters.data[0].node_count, 1u)] = WorkItem(parent, 0u);
}
