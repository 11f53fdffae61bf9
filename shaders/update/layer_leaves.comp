#version 460
// SPDX-License-Identifier: MIT
// Lists the leaves in a layer's brick table and gives each room for its voxels' sums. Their order is arbitrary, as sums
// do not depend on it. If a leaf has no room, its voxels are dropped, so that nothing is written past the end; the
// layer cannot be used then. In the end it is known whether there was room for everything.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(LayerLeavesParams, UPDATE_LAYER_LEAVES_CONSTANTS);
layout(local_size_x = kCollectGroup) in;

#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "lib/brick_keys.glsl"
#include "octree/found_bricks.glsl"

void listLeaves()
{
    FoundBricks found = findBricks(params.brick_capacity);
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

// Sets the members that no other subgroup touches.
void setCounters(LayerCounters counters)
{
    params.counters.data[0].failed = counters.failed;
    params.counters.data[0].overflow_count = counters.overflow_count;
    params.counters.data[0].big_count = counters.big_count;
    params.counters.data[0].block_count = counters.block_count;
    params.counters.data[0].blocks_exceeded = counters.blocks_exceeded;
    params.counters.data[0].nonfinite = counters.nonfinite;
    params.counters.data[0].out_of_range = counters.out_of_range;
    params.counters.data[0].outside = counters.outside;
    params.counters.data[0].zero_area = counters.zero_area;
}

// Checks whether there was room for everything that the layer's coverage has listed. By one thread.
void checkLayer()
{
    LayerCounters counters = LayerCounters(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    counters.leaf_count = atomicAdd(params.counters.data[0].leaf_count, 0u);
    counters.voxel_count = atomicAdd(params.counters.data[0].voxel_count, 0u);
    for (uint i = 0u; i < kClassCount; ++i)
        if (uint64_t(params.rasters[i]) != 0ul)
        {
            RasterCounters raster = params.rasters[i].data[0];
            counters.overflow_count += raster.overflow_count;
            counters.big_count = max(counters.big_count, raster.big_count);
            counters.block_count = max(counters.block_count, raster.block_count);
            counters.blocks_exceeded |= raster.blocks_exceeded;
            counters.nonfinite += raster.nonfinite;
            counters.out_of_range += raster.out_of_range;
            counters.outside += raster.outside;
            counters.zero_area += raster.zero_area;
        }
    bool failed = counters.overflow_count != 0u || counters.blocks_exceeded != 0u ||
                  counters.leaf_count > params.leaf_capacity || counters.voxel_count > params.voxel_capacity ||
                  counters.big_count > params.big_capacity || counters.block_count > params.block_capacity;
    counters.failed = failed ? 1u : 0u;
    setCounters(counters);
    params.reports.data[params.report] = counters;
}

void main()
{
    const uint block = kCollectGroup * kCollectItems;
    uint group_count = (params.brick_capacity + block - 1u) / block;
    if (workgroupIndex() >= group_count)
        return;
    listLeaves();
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kCollectGroup) && subgroupElect())
        checkLayer();
}
