#version 460
// SPDX-License-Identifier: MIT
// Makes voxels of sums: the mean of the fragments. Cells of a tile without fragments stay empty.
#extension GL_GOOGLE_include_directive : require
#include "baseline/crassin_green.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/resolve.glsl"

void main()
{
    LevelRange range = params.ranges.data[params.depth];
    uint index = threadIndex();
    if (index >= range.count || index >= params.sum_capacity)
        return;
    VoxelSums sums = VoxelSums_ConstPtr(uint64_t(params.sums) + uint64_t(index) * kVoxelSumsBytes).data[0];
    Attribute mean = resolveSums(params.scene, sums, 0u, kOpaqueColor >> 24);
    PointerNode voxel = PointerNode(kPointerVoxel, mean.color, mean.normal);
    params.nodes.data[range.first + index] = sums.fragments != 0u ? voxel : PointerNode(0u, 0u, 0u);
}
