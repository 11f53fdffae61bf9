#version 460
// SPDX-License-Identifier: MIT
// The attributes of mixed voxels from their sums: the means of their fragments. A thread takes a leaf.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(ResolveLeavesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kResolveGroup) in;

#define COLOR_BINDING 0
#define SUMS_BINDING 2
#define LEAVES_BINDING 3
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/mixed_leaf.glsl"
#include "voxelize/resolve.glsl"

void main()
{
    uint leaf = params.first_leaf + threadIndex();
    if (threadIndex() >= params.leaf_count)
        return;
    MixedVoxels mixed = loadMixedLeaf(leaf);
    uvec2 left = uvec2(mixed.mask_lo, mixed.mask_hi);
    if ((left.x | left.y) == 0u)
        return;
    Node node = loadLeaf(leaf);
    uint sums_index = mixed.first;
    for (; (left.x | left.y) != 0u; ++sums_index)
    {
        bool low = left.x != 0u;
        uint word = low ? left.x : left.y;
        uint cell = uint(findLSB(word)) + (low ? 0u : 32u);
        left = low ? uvec2(word & (word - 1u), left.y) : uvec2(0u, word & (word - 1u));
        VoxelSums sums = loadSums(sums_index);
        noteFragments(sums);
        STORE_MEAN(childIndex(node, cell), sums, 0u);
    }
}
