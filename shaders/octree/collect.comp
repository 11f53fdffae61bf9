#version 460
// SPDX-License-Identifier: MIT
// Lists the occupied entries of the brick table, and counts the voxels in them. The order of the list is arbitrary:
// nodes get their numbers from their place in the tree later.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#include "lib/dispatch.glsl"
#define SCAN_GROUP kCollectGroup
#include "lib/scan.glsl"

layout(local_size_x = kCollectGroup) in;
layout(push_constant, scalar) uniform Push
{
    CollectParams params;
};

shared uint s_first;

void main()
{
    uint entry = threadIndex();
    bool occupied = entry < params.brick_capacity && params.bricks.data[min(entry, params.brick_capacity - 1u)].key != 0u;
    uint voxels = 0u;
    if (occupied)
        voxels = bitCount(params.bricks.data[entry].mask_lo) + bitCount(params.bricks.data[entry].mask_hi);
    uint total;
    uint before = workgroupExclusiveAdd(occupied ? 1u : 0u, total);
    uint voxel_total;
    workgroupExclusiveAdd(voxels, voxel_total);
    if (gl_LocalInvocationIndex == 0u && total != 0u)
    {
        s_first = atomicAdd(params.counters.data[0].node_count, total);
        atomicAdd(params.counters.data[0].voxel_count, voxel_total);
    }
    barrier();
    if (occupied)
        params.items.data[s_first + before] = WorkItem(entry, 0u);
}
