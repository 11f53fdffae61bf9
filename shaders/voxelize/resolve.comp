#version 460
// SPDX-License-Identifier: MIT
// Computes the attribute of each voxel from its sums: the mean of its fragments.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"

GPU_ENTRY(ResolveParams, GPU_NO_CONSTANTS);
layout(local_size_x = kResolveGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define COLOR_BINDING 0
#define SUMS_BINDING 2
#include "voxelize/resolve.glsl"

void main()
{
    uint voxel = threadIndex();
    if (voxel >= params.voxel_count)
        return;
    VoxelSums sums = loadSums(voxel);
    noteFragments(sums);
    uint flags = 0u;
    if (params.has_emission != 0u && ((params.emission_words.data[voxel >> 5].x >> (voxel & 31u)) & 1u) != 0u)
        flags = kAttributeEmissive;
    STORE_MEAN(voxel, sums, flags);
}
