#version 460
// SPDX-License-Identifier: MIT
// Lists the leaves of a layer's bricks and gives each room for its voxels' sums: a workgroup a brick, a thread a leaf.
// Their order is arbitrary, as sums do not depend on it. In the end it is known whether there was room for everything;
// else the layer cannot be used, and its fragments are not shaded.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(LayerLeavesParams, UPDATE_LAYER_LEAVES_CONSTANTS);
layout(local_size_x = kBrickLeaves) in;

#define SCAN_GROUP kBrickLeaves
#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"
#include "voxelize/window.glsl"

#ifdef BOUND
TEXELS_2(0, masks);
#define MASKS(I) texelFetch(texels2_masks, int(I)).xy
#else
#define MASKS(I) uvec2_ConstPtr(uint64_t(params.masks)).data[I]
#endif

const int kLeavesShift = 16; // a brick has at most 4096 voxels: the sums of both counts fit one word

shared uvec2 s_first; // leaf and voxel of the brick
shared uvec2 s_masks; // of its leaves

void listLeaves(uint brick)
{
    uint leaf = gl_LocalInvocationIndex;
    uint entry = params.ranges.data[brick].entry;
    uvec2 key = keyOf(params.bricks.data[entry]);
    uvec2 mask = MASKS(brick * kBrickLeaves + leaf);
    bool has_voxels = (mask.x | mask.y) != 0u;
    uint low_voxels = bitCount(mask.x);
    if (leaf == 0u)
        s_masks = uvec2(0u);
    uint total;
    uint before = workgroupExclusiveAdd(low_voxels + bitCount(mask.y) + (has_voxels ? 1u << kLeavesShift : 0u), total);
    if (leaf == 0u)
        s_first = uvec2(atomicAdd(params.counters.data[0].leaf_count, total >> kLeavesShift),
                        atomicAdd(params.counters.data[0].voxel_count, bitfieldExtract(total, 0, kLeavesShift)));
    if (has_voxels && leaf < 32u)
        atomicOr(s_masks.x, 1u << leaf);
    if (has_voxels && leaf >= 32u)
        atomicOr(s_masks.y, 1u << (leaf - 32u));
    memoryBarrierShared();
    barrier();
    if (leaf == 0u)
    {
        uint first = params.brick_capacity + s_first.x;
        params.nodes.data[brick] = Node(s_masks.x, first, s_masks.y, first + bitCount(s_masks.x));
        if (kWideKeys)
            params.bricks.data[entry].mask_lo = brick;
        else
            params.bricks.data[entry].base = brick;
    }
    uint number = s_first.x + (before >> kLeavesShift);
    if (has_voxels && number < params.leaf_capacity)
    {
        uint first = s_first.y + bitfieldExtract(before, 0, kLeavesShift);
        params.keys.data[number] = gridDepth() > 2 ? childKey(key, leaf) : key;
        params.nodes.data[params.brick_capacity + number] = Node(mask.x, first, mask.y, first + low_voxels);
    }
}

// Checks whether there was room for everything. By one thread.
void checkLayer()
{
    LayerCounters counters = LayerCounters(atomicAdd(params.counters.data[0].leaf_count, 0u),
                                           atomicAdd(params.counters.data[0].voxel_count, 0u), 0u, 0u,
                                           params.bins.data[0]);
    bool failed = counters.bins.fits == 0u || counters.leaf_count > params.leaf_capacity ||
                  counters.voxel_count > params.voxel_capacity;
    counters.failed = failed ? 1u : 0u;
    params.counters.data[0].failed = counters.failed;
    params.reports.data[params.report] = counters;
    if (failed)
        params.bins.data[0].covered_items = 0u;
}

void main()
{
    uint brick_count = params.bins.data[0].listed_count;
    uint group_count = max(brick_count, 1u);
    if (workgroupIndex() >= group_count)
        return;
    if (workgroupIndex() < brick_count)
        listLeaves(workgroupIndex());
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kBrickLeaves) && subgroupElect())
        checkLayer();
}
