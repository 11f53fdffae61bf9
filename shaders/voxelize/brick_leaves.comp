#version 460
// SPDX-License-Identifier: MIT
// The nodes of the leaves of bricks, and their mixed voxels: a workgroup a brick, a thread a leaf.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BrickLeavesParams, VOXELIZE_BRICK_LEAVES_CONSTANTS);
layout(local_size_x = kBrickLeaves) in;

#define SCAN_GROUP kBrickLeaves
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"
#include "lib/scan.glsl"

void main()
{
    if (workgroupIndex() >= params.brick_count)
        return;
    uint leaf = gl_LocalInvocationIndex;
    uint brick = params.order.data[workgroupIndex()];
    BrickRange range = params.ranges.data[brick];
    uvec2_ConstPtr masks = uvec2_ConstPtr(uint64_t(params.masks) + uint64_t(brick) * (4u * kMaskWords));
    uvec2 mask = masks.data[leaf];
    uvec2 mixed = masks.data[kBrickLeaves + leaf];
    uint low_voxels = bitCount(mask.x);
    uint total;
    // A brick has at most 4096 voxels: both sums fit one word.
    uint before =
        workgroupExclusiveAdd(low_voxels + bitCount(mask.y) + ((bitCount(mixed.x) + bitCount(mixed.y)) << 16), total);
    uint first = range.first_voxel + (before & 0xFFFFu);
    if ((mask.x | mask.y) != 0u)
    {
        uint node = childIndex(params.nodes.data[nodeOf(params.bricks.data[range.entry])], leaf);
        params.nodes.data[node] = Node(mask.x, first, mask.y, first + low_voxels);
        params.mixed.data[node - params.first_leaf] =
            MixedVoxels(mixed.x, mixed.y, range.first_sums + (before >> 16), 0u);
    }
}
