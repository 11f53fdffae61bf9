#version 460
// SPDX-License-Identifier: MIT
// The nodes of the leaves of bricks, and their mixed voxels: a workgroup a brick, a thread a leaf.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BrickLeavesParams, VOXELIZE_BRICK_LEAVES_CONSTANTS);
layout(local_size_x = kBrickLeaves) in;

#define SCAN_GROUP kBrickLeaves
#include "lib/brick_keys.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"
#include "lib/scan.glsl"

#ifdef BOUND
TEXELS_2(0, masks);
#define MASKS(I) texelFetch(texels2_masks, int(I)).xy
#else
#define MASKS(I) uvec2_ConstPtr(uint64_t(params.masks)).data[I]
#endif

const int kMixedShift = 16; // a brick has at most 4096 voxels: the sums of both counts fit one word

void main()
{
    if (workgroupIndex() >= params.brick_count)
        return;
    uint leaf = gl_LocalInvocationIndex;
    uint brick = params.order.data[workgroupIndex()];
    BrickRange range = params.ranges.data[brick];
    uint first_mask = brick * ((kMixed ? 2u : 1u) * kBrickLeaves);
    uvec2 mask = MASKS(first_mask + leaf);
    uvec2 mixed = kMixed ? MASKS(first_mask + kBrickLeaves + leaf) : uvec2(0u);
    uint low_voxels = bitCount(mask.x);
    uint total;
    uint mixed_voxels = bitCount(mixed.x) + bitCount(mixed.y);
    uint before = workgroupExclusiveAdd(low_voxels + bitCount(mask.y) + (mixed_voxels << kMixedShift), total);
    uint first = range.first_voxel + bitfieldExtract(before, 0, kMixedShift);
    if ((mask.x | mask.y) != 0u)
    {
        uint node = 0u; // of a grid of up to 4^3: a leaf without nodes above it
        if (params.first_leaf != 0u)
            node = childIndex(params.nodes.data[nodeOf(params.bricks.data[range.entry])], leaf);
        params.nodes.data[node] = Node(mask.x, first, mask.y, first + low_voxels);
        if (kMixed)
            params.mixed.data[node - params.first_leaf] =
                MixedVoxels(mixed.x, mixed.y, range.first_sums + (before >> kMixedShift), 0u);
    }
}
