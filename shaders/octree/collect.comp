#version 460
// SPDX-License-Identifier: MIT
// Lists the occupied entries of the brick table, and counts the voxels in them. The order of the list is arbitrary:
// nodes get their numbers from their position in the tree later. So is that of the sums of mixed voxels, for which each
// leaf gets room.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(CollectParams, OCTREE_COLLECT_CONSTANTS);
layout(local_size_x = kCollectGroup) in;

#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "octree/nodes.glsl"

#define BRICKS_BINDING 0
#include "lib/brick_loads.glsl"
#include "octree/found_bricks.glsl"

// Gives the mixed voxels of a leaf room for their sums.
void placeMixed(uint entry)
{
    MixedVoxels mixed = loadMixed(params.brick_capacity, entry);
    uint count = bitCount(mixed.mask_lo) + bitCount(mixed.mask_hi);
    uint64_t behind = uint64_t(params.bricks) + uint64_t(params.brick_capacity) * kBrickBytes;
    if (count != 0u)
        MixedVoxels_Ptr(behind).data[entry].first = atomicAdd(params.counters.data[0].mixed_count, count);
}

void main()
{
    FoundBricks found = findBricks(params.brick_capacity);
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
        uint entry = takeBrick(found);
        params.items.data[slot] = WorkItem(entry, 0u);
        if (kMixed)
            placeMixed(entry);
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
