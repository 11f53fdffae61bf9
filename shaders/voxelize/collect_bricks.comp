#version 460
// SPDX-License-Identifier: MIT
// Lists the bricks that have voxels as work items of octree construction, in the place of leaves, and counts their
// leaves and voxels. Those that are full and have no surface are left to voxelize/fill_nodes.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(CollectBricksParams, VOXELIZE_COLLECT_BRICKS_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "octree/nodes.glsl"

#ifdef BOUND
TEXELS_4(0, masks);
TEXELS_4(1, crossings);
#define MASK_WORDS(I) texelFetch(texels4_masks, int(I))
#define INSIDE_WORDS(I) texelFetch(texels4_crossings, int(I))
#else
#define INSIDE_WORDS(I) uvec4_ConstPtr(uint64_t(params.crossings)).data[I]
#define MASK_WORDS(I) uvec4_ConstPtr(uint64_t(params.masks)).data[I]
#endif

shared uint s_leaves_lo[kBricksGroup];
shared uint s_leaves_hi[kBricksGroup];
shared uint s_voxels[kBricksGroup];
shared uint s_mixed[kBricksGroup];
shared uint s_filled[kFillWords != 0u ? kBricksGroup : 1u]; // voxels that are inside alone

uint bitCounts(uvec4 words)
{
    return bitCount(words.x) + bitCount(words.y) + bitCount(words.z) + bitCount(words.w);
}

// Counts the part of a brick that a thread takes. slot: of the brick in the workgroup.
void countBrick(uint brick, uint slot)
{
    uvec2 leaves = uvec2(0u);
    uint voxels = 0u;
    uint mixed = 0u;
    uint filled = 0u;
    uint first = brick * ((kMixed ? 2u : 1u) * kLeafMaskWords / 4u);
    uint first_inside = brick * (kFillWords / 4u);
    for (uint pair = gl_LocalInvocationIndex % kBrickLanes; pair < kBrickLeaves / 2u; pair += kBrickLanes)
    {
        uvec4 words = MASK_WORDS(first + pair);
        uvec4 occupied = words;
        if (kFillWords != 0u)
        {
            occupied |= INSIDE_WORDS(first_inside + pair);
            filled += bitCounts(occupied & ~words);
        }
        uint found = ((occupied.x | occupied.y) != 0u ? 1u : 0u) | ((occupied.z | occupied.w) != 0u ? 2u : 0u);
        found <<= (2u * pair) & 31u;
        leaves |= pair < kBrickLeaves / 4u ? uvec2(found, 0u) : uvec2(0u, found);
        voxels += bitCounts(words);
        if (kMixed)
            mixed += bitCounts(MASK_WORDS(first + kLeafMaskWords / 4u + pair));
    }
    if (kFillWords != 0u && filled != 0u)
        atomicAdd(s_filled[slot], filled);
    if ((leaves.x | leaves.y) != 0u)
    {
        atomicOr(s_leaves_lo[slot], leaves.x);
        atomicOr(s_leaves_hi[slot], leaves.y);
        atomicAdd(s_voxels[slot], voxels);
        atomicAdd(s_mixed[slot], mixed);
    }
}

void addFilled(uint filled)
{
    uint before = atomicAdd(params.counters.data[0].filled_lo, filled);
    if (before + filled < before)
        atomicAdd(params.counters.data[0].filled_hi, 1u);
}

void main()
{
    uint brick_count = params.counters.data[0].listed_count;
    uint group_count = (brick_count + kBricksGroup - 1u) / kBricksGroup;
    if (workgroupIndex() >= group_count)
        return;
    uint lane = gl_LocalInvocationIndex;
    s_leaves_lo[lane] = 0u;
    s_leaves_hi[lane] = 0u;
    s_voxels[lane] = 0u;
    s_mixed[lane] = 0u;
    if (kFillWords != 0u)
        s_filled[lane] = 0u;
    barrier();
    for (uint slot = lane / kBrickLanes; slot < kBricksGroup; slot += kBricksGroup / kBrickLanes)
        if (workgroupIndex() * kBricksGroup + slot < brick_count)
            countBrick(workgroupIndex() * kBricksGroup + slot, slot);
    barrier();
    uint brick = threadIndex();
    uint entry = 0u;
    uvec2 leaves = uvec2(s_leaves_lo[lane], s_leaves_hi[lane]);
    uint voxels = s_voxels[lane];
    uint filled = kFillWords != 0u ? s_filled[lane] : 0u;
    if (filled == kBrickVoxels)
    {
        leaves = uvec2(0u);
        filled = 0u;
    }
    if (brick < brick_count)
    {
        entry = params.ranges.data[brick].entry;
        params.bricks.data[entry].mask_lo = leaves.x;
        params.bricks.data[entry].mask_hi = leaves.y;
    }
    bool has_voxels = (leaves.x | leaves.y) != 0u;
    uvec4 total = subgroupAdd(
        uvec4(has_voxels ? 1u : 0u, bitCount(leaves.x) + bitCount(leaves.y), voxels, s_mixed[lane]));
    uint sums_before = subgroupExclusiveAdd(s_mixed[lane]);
    uint before = subgroupExclusiveAdd(has_voxels ? 1u : 0u);
    uint total_filled = kFillWords != 0u ? subgroupAdd(filled) : 0u;
    uvec2 first = uvec2(0u); // work item, sums
    if (subgroupElect() && total.x != 0u)
    {
        first.x = atomicAdd(params.nodes.data[0].node_count, total.x);
        first.y = atomicAdd(params.counters.data[0].mixed_count, total.w);
        atomicAdd(params.counters.data[0].leaf_count, total.y);
        uint voxels_before = atomicAdd(params.counters.data[0].voxel_count, total.z);
        if (voxels_before + total.z < voxels_before)
            atomicAdd(params.counters.data[0].voxel_carry, 1u);
        if (kFillWords != 0u)
            addFilled(total_filled);
    }
    first = subgroupBroadcastFirst(first);
    uint item = first.x + before;
    if (brick < brick_count)
        params.ranges.data[brick] = BrickRange(entry, voxels, 0u, first.y + sums_before);
    if (has_voxels)
    {
        params.work.data[item] = WorkItem(entry, 0u);
        params.work_bricks.data[item] = brick;
    }
    uint here = arrivingThreads();
    uint arrived = subgroupElect() ? atomicAdd(params.nodes.data[0].arrived[0], here) : 0u;
    if (areLastThreads(arrived, here, group_count * kBricksGroup) && subgroupElect())
        setLevel(params.levels, params.args, 0u, atomicAdd(params.nodes.data[0].node_count, 0u), params.max_groups_x);
}
