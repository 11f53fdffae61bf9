#version 460
// SPDX-License-Identifier: MIT
// From an emissive voxel's sums to its radiance: the mean over all its fragments, as shared-exponent RGB9E5.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"
#include "lib/dispatch.glsl"
#include "lib/divide.glsl"

layout(local_size_x = kResolveGroup) in;
layout(push_constant, scalar) uniform Push
{
    ResolveEmissionParams params;
};

// 16-bit fractions to RGB9E5 (value = mantissa * 2^(exponent - 24)): the exponent fits the largest channel, what lies
// below nine bits is cut off.
uint encodeRgb9e5(uvec3 fraction)
{
    int top = findMSB(max(fraction.r, max(fraction.g, fraction.b)) | 1u);
    int shift = max(top - 8, 0); // to nine bits
    uvec3 mantissa = fraction >> shift;
    uint exponent = uint(shift + 8); // fractions count 2^-16
    return mantissa.r | (mantissa.g << 9) | (mantissa.b << 18) | (exponent << 27);
}

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
    uint count = max(params.sums.data[voxel].fragments, 1u);
    EmissionSums sums = params.emission_sums.data[rank];
    uvec3 sum = uvec3(sums.red, sums.green, sums.blue);
    uvec3 mean = min(divideSmall(sum + count / 2u, count) << params.sum_shift, uvec3(kFractionOne));
    params.emission.data[rank] = encodeRgb9e5(mean);
}
