#version 460
// SPDX-License-Identifier: MIT
// Computes the radiance of each emissive voxel from its sums: the mean over all its fragments, as shared-exponent
// RGB9E5.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"

GPU_ENTRY(ResolveEmissionParams, GPU_NO_CONSTANTS);
layout(local_size_x = kResolveGroup) in;

#include "lib/dispatch.glsl"
#include "voxelize/resolve.glsl"

void main()
{
    uint voxel = threadIndex();
    if (voxel >= params.voxel_count)
        return;
    uvec2 word = params.emission_words.data[voxel >> 5];
    uint bit = 1u << (voxel & 31u);
    if ((word.x & bit) == 0u)
        return;
    uint rank = word.y + bitCount(word.x & (bit - 1u));
    params.emission.data[rank] =
        resolveEmission(params.emission_sums.data[rank], params.sums.data[voxel].fragments, params.sum_shift);
}
