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

uvec2 mixedOf(uint leaf_mask)
{
    return kMixed ? MASKS(leaf_mask + kBrickLeaves) : uvec2(0u);
}

void main()
{
    uint number = threadIndex() / kBrickLanes;
    uint brick = params.order.data[min(number, params.brick_count - 1u)];
    uint leaf = laneOfBrick() * kLaneLeaves;
    uint first_mask = brick * ((kMixed ? 2u : 1u) * kBrickLeaves) + leaf;
    uint counts = 0u; // voxels, and mixed ones
    for (uint i = 0u; i < kLaneLeaves; ++i)
    {
        uvec2 mask = MASKS(first_mask + i);
        uvec2 mixed = mixedOf(first_mask + i);
        counts += bitCount(mask.x) + bitCount(mask.y) + ((bitCount(mixed.x) + bitCount(mixed.y)) << kSecondCount);
    }
    uint total;
    uint before = countsBefore(counts, total);
    if (number >= params.brick_count)
        return;
    BrickRange range = params.ranges.data[brick];
    uint voxel = range.first_voxel + bitfieldExtract(before, 0, kSecondCount);
    uint sums = range.first_sums + (before >> kSecondCount);
    Node parent = Node(0u, 0u, 0u, 0u); // a grid of up to 4^3 is a leaf without nodes above it
    if (params.first_leaf != 0u)
        parent = params.nodes.data[nodeOf(params.bricks.data[range.entry])];
    for (uint i = 0u; i < kLaneLeaves; ++i)
    {
        uvec2 mask = MASKS(first_mask + i);
        uvec2 mixed = mixedOf(first_mask + i);
        uint middle = voxel + bitCount(mask.x);
        if ((mask.x | mask.y) != 0u)
        {
            uint node = childIndex(parent, leaf + i);
            params.nodes.data[node] = Node(mask.x, voxel, mask.y, middle);
            if (kMixed)
                params.mixed.data[node - params.first_leaf] = MixedVoxels(mixed.x, mixed.y, sums, 0u);
        }
        voxel = middle + bitCount(mask.y);
        sums += bitCount(mixed.x) + bitCount(mixed.y);
    }
}
