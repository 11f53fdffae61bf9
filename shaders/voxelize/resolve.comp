#version 460
// SPDX-License-Identifier: MIT
// Computes the attribute of each voxel from its sums: the mean of its fragments.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"
#include "lib/dispatch.glsl"
#include "lib/resolve.glsl"

layout(local_size_x = kResolveGroup) in;
layout(push_constant, scalar) uniform Push
{
    ResolveParams params;
};

void main()
{
    uint voxel = threadIndex();
    if (voxel >= params.voxel_count)
        return;
    VoxelSums sums = params.sums.data[voxel];
    if ((sums.fragments >> params.sum_shift) > kFragmentsMax)
        atomicMax(params.max_fragments.data[0], sums.fragments);
    uint flags = 0u;
    if (params.has_emission != 0u && ((params.emission_words.data[voxel >> 5].x >> (voxel & 31u)) & 1u) != 0u)
        flags = kAttributeEmissive;
    params.attributes.data[voxel] = resolveSums(params.scene, sums, params.sum_shift, flags);
}
