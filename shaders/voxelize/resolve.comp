#version 460
// SPDX-License-Identifier: MIT
// From a voxel's sums to its attribute: the mean of its fragments.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"
#include "lib/attribute.glsl"
#include "lib/dispatch.glsl"

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
    uint count = sums.fragments;
    if ((count >> params.sum_shift) > kFragmentsMax)
        atomicMax(params.max_fragments.data[0], count);
    uint divisor = max(count, 1u);
    uvec3 sum = uvec3(sums.red, sums.green, sums.blue);
    uvec3 color = min(divideSmall(sum + divisor / 2u, divisor) << params.sum_shift, uvec3(kFractionOne));
    ivec3 normal = ivec3(sums.normal_x, sums.normal_y, sums.normal_z);
    uint flags = 0u;
    if (params.has_emission != 0u && ((params.emission_words.data[voxel >> 5].x >> (voxel & 31u)) & 1u) != 0u)
        flags = kAttributeEmissive;
    params.attributes.data[voxel] = Attribute(packColor(params.scene, color, flags), encodeNormal(normal));
}
