#version 460
// SPDX-License-Identifier: MIT
// Lists the leaves of a layer's bricks and gives each room for its voxels' sums: kBrickLanes threads a brick.
// Their order is arbitrary, as sums do not depend on it. In the end it is known whether there was room for everything;
// else the layer cannot be used, and its fragments are not shaded. Of a layer that carves, a brick's leaves that are
// inside as a whole are children of the brick, which is listed as well.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(LayerLeavesParams, UPDATE_LAYER_LEAVES_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/brick_lanes.glsl"
#include "voxelize/window.glsl"

// What of a leaf is inside.
#ifdef BOUND
TEXELS_2(1, crossings);
#define INSIDE(I) texelFetch(texels2_crossings, int(I)).xy
#else
#define INSIDE(I) uvec2_ConstPtr(uint64_t(params.crossings)).data[I]
#endif

const uint kGroupBricks = kBricksGroup / kBrickLanes;

shared uvec2 s_firsts[kGroupBricks]; // leaf and voxel of each brick
shared uint s_masks_lo[kGroupBricks]; // of its leaves
shared uint s_masks_hi[kGroupBricks];
shared uint s_full_lo[kCarves ? kGroupBricks : 1u]; // of those that are inside as a whole
shared uint s_full_hi[kCarves ? kGroupBricks : 1u];

// The mask of a leaf of a brick.
uvec2 leafMask(uint brick, uint leaf)
{
    uvec2 mask = MASKS(brick * kBrickLeaves + leaf);
    if (kFillWords != 0u)
        mask |= INSIDE(brick * (kFillWords / 2u) + leaf);
    return mask;
}

// Whether a leaf is listed as a child of its brick: all is inside, nothing is on the surface.
bool isInside(uint brick, uint leaf)
{
    bool inside = false;
    if (kCarves && kFillWords != 0u && gridDepth() > 2) // smaller grids have no bricks as nodes
    {
        uvec2 surface = MASKS(brick * kBrickLeaves + leaf);
        uvec2 mask = INSIDE(brick * (kFillWords / 2u) + leaf);
        inside = (surface.x | surface.y) == 0u && (mask.x & mask.y) == ~0u;
    }
    return inside;
}

// By one thread of a brick.
void listBrick(uvec2 key, uvec2 full)
{
    uint number = atomicAdd(params.counters.data[0].leaf_count, 1u);
    if (number < params.leaf_capacity)
    {
        params.keys.data[number] = key;
        params.nodes.data[params.brick_capacity + number] = Node(full.x, 0u, full.y, 0u);
    }
}

// brick: the thread's, of brick_count.
void listLeaves(uint brick, uint brick_count)
{
    bool exists = brick < brick_count;
    uint slot = gl_LocalInvocationIndex / kBrickLanes;
    uint leaf = laneOfBrick() * kLaneLeaves;
    uint known_brick = min(brick, max(brick_count, 1u) - 1u);
    uint counts = 0u; // voxels, and leaves
    uint leaves = 0u;
    uint full = 0u;
    for (uint i = 0u; i < kLaneLeaves; ++i)
    {
        uvec2 mask = leafMask(known_brick, leaf + i);
        bool inside = exists && isInside(known_brick, leaf + i);
        full |= inside ? 1u << (leaf + i & 31u) : 0u;
        bool has_voxels = exists && (mask.x | mask.y) != 0u && !inside;
        leaves |= has_voxels ? 1u << (leaf + i & 31u) : 0u;
        counts += has_voxels ? bitCount(mask.x) + bitCount(mask.y) + (1u << kSecondCount) : 0u;
    }
    if (laneOfBrick() == 0u)
    {
        s_masks_lo[slot] = 0u;
        s_masks_hi[slot] = 0u;
        if (kCarves)
        {
            s_full_lo[slot] = 0u;
            s_full_hi[slot] = 0u;
        }
    }
    uint total;
    uint before = countsBefore(counts, total);
    if (laneOfBrick() == 0u && exists)
        s_firsts[slot] = uvec2(atomicAdd(params.counters.data[0].leaf_count, total >> kSecondCount),
                               atomicAdd(params.counters.data[0].voxel_count, bitfieldExtract(total, 0, kSecondCount)));
    if (leaf < 32u)
        atomicOr(s_masks_lo[slot], leaves);
    else
        atomicOr(s_masks_hi[slot], leaves);
    if (kCarves && leaf < 32u)
        atomicOr(s_full_lo[slot], full);
    else if (kCarves)
        atomicOr(s_full_hi[slot], full);
    memoryBarrierShared();
    barrier();
    if (!exists)
        return;
    uint entry = params.ranges.data[brick].entry;
    uvec2 key = keyOf(params.bricks.data[entry]);
    uvec2 first = s_firsts[slot];
    if (laneOfBrick() == 0u)
    {
        uvec2 masks = uvec2(s_masks_lo[slot], s_masks_hi[slot]);
        uint child = params.brick_capacity + first.x;
        params.nodes.data[brick] = Node(masks.x, child, masks.y, child + bitCount(masks.x));
        if (kWideKeys)
            params.bricks.data[entry].mask_lo = brick;
        else
            params.bricks.data[entry].base = brick;
        if (kCarves && (s_full_lo[slot] | s_full_hi[slot]) != 0u)
            listBrick(key, uvec2(s_full_lo[slot], s_full_hi[slot]));
    }
    uint number = first.x + (before >> kSecondCount);
    uint voxel = first.y + bitfieldExtract(before, 0, kSecondCount);
    for (leaves >>= leaf & 31u; leaves != 0u; leaves &= leaves - 1u)
    {
        uint i = findLSB(leaves);
        uvec2 mask = leafMask(known_brick, leaf + i);
        uint middle = voxel + bitCount(mask.x);
        if (number < params.leaf_capacity)
        {
            params.keys.data[number] = gridDepth() > 2 ? childKey(key, leaf + i) : key;
            params.nodes.data[params.brick_capacity + number] = Node(mask.x, voxel, mask.y, middle);
        }
        ++number;
        voxel = middle + bitCount(mask.y);
    }
}

// Checks whether there was room for everything. By one thread.
void checkLayer()
{
    LayerCounters counters = LayerCounters(atomicAdd(params.counters.data[0].leaf_count, 0u),
                                           atomicAdd(params.counters.data[0].voxel_count, 0u), 0u, 0u,
                                           params.bins.data[0]);
    bool failed = counters.bins.fits == 0u || counters.bins.overflow_count != 0u ||
                  counters.bins.crossings_exceeded != 0u || counters.leaf_count > params.leaf_capacity ||
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
    uint group_count = max((brick_count + kGroupBricks - 1u) / kGroupBricks, 1u);
    if (workgroupIndex() >= group_count)
        return;
    listLeaves(threadIndex() / kBrickLanes, brick_count);
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kBricksGroup) && subgroupElect())
        checkLayer();
}
