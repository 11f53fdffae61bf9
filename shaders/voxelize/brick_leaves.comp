#version 460
// SPDX-License-Identifier: MIT
// The nodes of the leaves of bricks, and their mixed voxels: kBrickLanes threads a brick.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BrickLeavesParams, VOXELIZE_BRICK_LEAVES_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#include "lib/brick_keys.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"
#include "voxelize/brick_lanes.glsl"

#ifdef BOUND
TEXELS_2(1, crossings);
#define INSIDE(I) texelFetch(texels2_crossings, int(I)).xy
#else
#define INSIDE(I) uvec2_ConstPtr(uint64_t(params.crossings)).data[I]
#endif

uvec2 mixedOf(uint leaf_mask)
{
    return kMixed ? MASKS(leaf_mask + kBrickLeaves) : uvec2(0u);
}

void main()
{
    uint number = threadIndex() / kBrickLanes;
    bool is_brick = number < params.brick_count;
    uint brick = params.order.data[min(number, params.brick_count - 1u)];
    if (kFillWords != 0u && brick == kNoRange)
    {
        is_brick = false;
        brick = 0u;
    }
    BrickRange range = params.ranges.data[brick];
    Node parent = Node(1u, 0u, 0u, 0u); // a grid of up to 4^3 is a leaf without nodes above it
    if (params.first_leaf != 0u)
        parent = params.nodes.data[nodeOf(params.bricks.data[range.entry])];
    uint first_leaf = laneOfBrick() * kLaneLeaves;
    uint leaves = first_leaf < 32u ? parent.mask_lo : parent.mask_hi; // of them this lane's, most are often empty
    leaves = is_brick ? bitfieldExtract(leaves, int(first_leaf & 31u), int(kLaneLeaves)) : 0u;
    uint first_mask = brick * ((kMixed ? 2u : 1u) * kBrickLeaves) + first_leaf;
    uint counts = 0u; // voxels, and mixed ones
    for (uint rest = leaves; rest != 0u; rest &= rest - 1u)
    {
        uvec2 mask = MASKS(first_mask + findLSB(rest));
        uvec2 mixed = mixedOf(first_mask + findLSB(rest));
        counts += bitCount(mask.x) + bitCount(mask.y) + ((bitCount(mixed.x) + bitCount(mixed.y)) << kSecondCount);
    }
    uint total;
    uint before = countsBefore(counts, total);
    uint voxel = range.first_voxel + bitfieldExtract(before, 0, kSecondCount);
    uint sums = range.first_sums + (before >> kSecondCount);
    for (; leaves != 0u; leaves &= leaves - 1u)
    {
        uint leaf = findLSB(leaves);
        uvec2 mask = MASKS(first_mask + leaf);
        uvec2 mixed = mixedOf(first_mask + leaf);
        uint middle = voxel + bitCount(mask.x);
        uint node = childIndex(parent, first_leaf + leaf);
        params.nodes.data[node] = Node(mask.x, voxel, mask.y, middle);
        if (kFillWords != 0u)
            params.occupied.data[node - params.first_leaf] =
                mask | INSIDE(brick * (kFillWords / 2u) + first_leaf + leaf);
        if (kMixed)
            params.mixed.data[node - params.first_leaf] = MixedVoxels(mixed.x, mixed.y, sums, 0u);
        voxel = middle + bitCount(mask.y);
        sums += bitCount(mixed.x) + bitCount(mixed.y);
    }
}
