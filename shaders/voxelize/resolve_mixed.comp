#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of mixed voxels from their sums: the means of their fragments. Threads that share a leaf take
// every kLanes-th of its cells.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"

GPU_ENTRY(ResolveMixedParams, VOXELIZE_RESOLVE_MIXED_CONSTANTS);
layout(local_size_x = kResolveGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define BRICKS_BINDING 3
#define COLOR_BINDING 0
#define SUMS_BINDING 2
#include "lib/brick_keys.glsl"
#include "lib/brick_loads.glsl"
#include "voxelize/resolve.glsl"

uint rankOf(uint mask, uint cell)
{
    return bitCount(mask & ((1u << cell) - 1u));
}

// Resolves the mixed voxels of half a leaf. first_sums, first_voxel: of the half.
void resolveHalf(uint mixed, uint mask, uint first_sums, uint first_voxel, uint cells)
{
    for (uint left = mixed & cells; left != 0u; left &= left - 1u)
    {
        uint cell = uint(findLSB(left));
        VoxelSums sums = loadSums(first_sums + rankOf(mixed, cell));
        noteFragments(sums);
        STORE_MEAN(first_voxel + rankOf(mask, cell), sums, 0u);
    }
}

void main()
{
    uint leaf = threadIndex() / kLanes;
    if (leaf >= params.leaf_count)
        return;
    uint entry = params.items.data[leaf].entry;
    MixedVoxels mixed = loadMixed(params.brick_mask + 1u, entry);
    BrickEntry brick = loadBrick(entry);
    uvec2 masks = uvec2(brick.mask_lo, brick.mask_hi);
    uint base = brick.base;
    if (kWideKeys)
    {
        Node node = params.nodes.data[nodeOf(brick)];
        masks = uvec2(node.mask_lo, node.mask_hi);
        base = node.base_lo;
    }
    const uint every = kLanes == 1u ? ~0u : ~0u / ((1u << kLanes) - 1u); // every kLanes-th bit
    uint cells = every << (threadIndex() & (kLanes - 1u));
    resolveHalf(mixed.mask_lo, masks.x, mixed.first, base, cells);
    resolveHalf(mixed.mask_hi, masks.y, mixed.first + bitCount(mixed.mask_lo), base + bitCount(masks.x), cells);
}
