#version 460
// SPDX-License-Identifier: MIT
// Makes cells of the sums over their fragments, for comparisons with zvo: the thesis keeps the last fragment instead.
#extension GL_GOOGLE_include_directive : require
#include "baseline/thesis.h"

GPU_ENTRY(ThesisResolveParams, GPU_NO_CONSTANTS);
layout(local_size_x = kThesisGroup) in;

#include "lib/dispatch.glsl"
#include "voxelize/resolve.glsl"

void main()
{
    uint index = threadIndex();
    if (index >= params.cell_count)
        return;
    uint cell = params.first_cell + index;
    VoxelSums sums = VoxelSums_ConstPtr(uint64_t(params.sums) + uint64_t(cell) * kVoxelSumsBytes).data[0];
    uint64_t look = packAttribute(resolveSums(params.scene, sums, 0u, kOpaqueColor >> 24));
    uint64_t_Ptr(uint64_t(params.cells)).data[cell] = sums.fragments != 0u ? look : 0ul;
}
