#version 460
// SPDX-License-Identifier: MIT
// Lists the bricks that have voxels as work items of octree construction, in the place of leaves, and counts.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(CollectBricksParams, GPU_NO_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "octree/nodes.glsl"

void main()
{
    uint brick_count = params.counters.data[0].listed_count;
    uint group_count = (brick_count + kBricksGroup - 1u) / kBricksGroup;
    if (workgroupIndex() >= group_count)
        return;
    uint brick = threadIndex();
    BrickRange range = BrickRange(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    if (brick < brick_count)
        range = params.ranges.data[brick];
    bool has_voxels = range.voxels != 0u;
    uint leaves = 0u;
    if (has_voxels)
        leaves = bitCount(params.bricks.data[range.entry].mask_lo) + bitCount(params.bricks.data[range.entry].mask_hi);
    uvec3 total = subgroupAdd(uvec3(has_voxels ? 1u : 0u, leaves, range.voxels));
    uint before = subgroupExclusiveAdd(has_voxels ? 1u : 0u);
    uint first = 0u;
    if (subgroupElect() && total.x != 0u)
    {
        first = atomicAdd(params.nodes.data[0].node_count, total.x);
        atomicAdd(params.counters.data[0].leaf_count, total.y);
        uint voxels_before = atomicAdd(params.counters.data[0].voxel_count, total.z);
        if (voxels_before + total.z < voxels_before)
            atomicAdd(params.counters.data[0].voxel_carry, 1u);
    }
    uint item = subgroupBroadcastFirst(first) + before;
    if (has_voxels)
    {
        params.work.data[item] = WorkItem(range.entry, 0u);
        params.work_bricks.data[item] = brick;
        if (range.units > 1u)
            params.ranges.data[brick].first_sums = atomicAdd(params.counters.data[0].summed_voxels, range.voxels);
    }
    uint here = arrivingThreads();
    uint arrived = subgroupElect() ? atomicAdd(params.nodes.data[0].arrived[0], here) : 0u;
    if (areLastThreads(arrived, here, group_count * kBricksGroup) && subgroupElect())
        setLevel(params.levels, params.args, 0u, atomicAdd(params.nodes.data[0].node_count, 0u), params.max_groups_x);
}
