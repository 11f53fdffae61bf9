#version 460
// SPDX-License-Identifier: MIT
// Lists the occupied entries of the brick table, and counts the voxels in them. The order of the list is arbitrary:
// nodes get their numbers from their position in the tree later.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "lib/found_bricks.glsl"
#include "octree/levels.glsl"

layout(local_size_x = kCollectGroup) in;
layout(push_constant, scalar) uniform Push
{
    CollectParams params;
};

void main()
{
    FoundBricks found = findBricks(params.bricks, params.brick_capacity);
    uint first = 0u;
    if (subgroupElect() && found.total.x != 0u)
    {
        first = atomicAdd(params.counters.data[0].node_count, found.total.x);
        uint voxels_before = atomicAdd(params.counters.data[0].voxel_count, found.total.y);
        if (voxels_before + found.total.y < voxels_before)
            atomicAdd(params.counters.data[0].voxel_carry, 1u);
    }
    uint slot = subgroupBroadcastFirst(first) + found.before.x;
    for (; found.occupied != 0u;)
    {
        params.items.data[slot] = WorkItem(takeBrick(found), 0u);
        ++slot;
    }
    const uint block = kCollectGroup * kCollectItems;
    uint group_count = (params.brick_capacity + block - 1u) / block;
    if (workgroupIndex() >= group_count)
        return;
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived[0], here) : 0u;
    if (areLastThreads(before, here, group_count * kCollectGroup) && subgroupElect())
        setLevel(params.ranges, params.args, 0u, atomicAdd(params.counters.data[0].node_count, 0u),
                 params.max_groups_x);
}
