#version 460
// SPDX-License-Identifier: MIT
// Lists the occupied entries of the brick table, and counts the voxels in them. The order of the list is arbitrary:
// nodes get their numbers from their place in the tree later. One atomic a subgroup, no barriers.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "octree/octree.h"
#include "lib/dispatch.glsl"

layout(local_size_x = kCollectGroup) in;
layout(push_constant, scalar) uniform Push
{
    CollectParams params;
};

void main()
{
    uint start = workgroupIndex() * (kCollectGroup * kCollectItems) + gl_LocalInvocationIndex;
    uint occupied = 0u; // bit i: the thread's entry i
    uint voxels = 0u;
    for (uint i = 0u; i < kCollectItems; ++i)
    {
        uint entry = start + i * kCollectGroup;
        if (entry < params.brick_capacity && params.bricks.data[entry].key != 0u)
        {
            occupied |= 1u << i;
            voxels += bitCount(params.bricks.data[entry].mask_lo) + bitCount(params.bricks.data[entry].mask_hi);
        }
    }
    uint count = bitCount(occupied);
    uint before = subgroupExclusiveAdd(count);
    uint total = subgroupAdd(count);
    uint voxel_total = subgroupAdd(voxels);
    uint first = 0u;
    if (subgroupElect() && total != 0u)
    {
        first = atomicAdd(params.counters.data[0].node_count, total);
        uint voxels_before = atomicAdd(params.counters.data[0].voxel_count, voxel_total);
        if (voxels_before + voxel_total < voxels_before)
            atomicAdd(params.counters.data[0].voxel_carry, 1u);
    }
    uint slot = subgroupBroadcastFirst(first) + before;
    for (; occupied != 0u; occupied &= occupied - 1u)
    {
        params.items.data[slot] = WorkItem(start + uint(findLSB(occupied)) * kCollectGroup, 0u);
        ++slot;
    }
}
