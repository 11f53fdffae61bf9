#version 460
// SPDX-License-Identifier: MIT
// Adds fragments to the sums of their voxels. The paper keeps a running mean of 8-bit colours by compare-and-swap; sums
// need no loops and do not depend on the order of fragments.
#extension GL_GOOGLE_include_directive : require
#include "baseline/crassin_green.glsl"
#include "lib/attribute.glsl"
#include "lib/dispatch.glsl"
#include "lib/normal.glsl"

#define SUM_WORD(VOXEL, WORD) uint_Ptr(uint64_t(params.sums) + uint64_t(VOXEL) * kVoxelSumsBytes).data[WORD]

void main()
{
    uint index = threadIndex();
    if (index >= params.fragment_count)
        return;
    VoxelFragment fragment = params.fragments.data[index];
    uint node = nodeOf(fragment, params.depth);
    uint voxel = node - params.ranges.data[params.depth].first;
    if (node == kNoNode || voxel >= params.sum_capacity)
        return;
    LinearTable to_linear = LINEAR_TABLE(params.scene);
    uvec3 color = linearColor(to_linear, fragment.color);
    uvec3 normal = uvec3(decodeNormal(fragment.normal)) + normalBias(0u);
    atomicAdd(SUM_WORD(voxel, 0u), color.r);
    atomicAdd(SUM_WORD(voxel, 1u), color.g);
    atomicAdd(SUM_WORD(voxel, 2u), color.b);
    atomicAdd(SUM_WORD(voxel, 3u), normal.x);
    atomicAdd(SUM_WORD(voxel, 4u), normal.y);
    atomicAdd(SUM_WORD(voxel, 5u), normal.z);
    atomicAdd(SUM_WORD(voxel, 6u), 1u);
}
