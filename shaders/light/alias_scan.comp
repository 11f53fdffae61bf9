#version 460
// SPDX-License-Identifier: MIT
// Replaces the sums of each block by those of the blocks before it, and writes what a face receives.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"

GPU_ENTRY(AliasParams, GPU_NO_CONSTANTS);
layout(local_size_x = kAliasGroup) in;

#include "lib/dispatch.glsl"
#include "light/alias.glsl"

void main()
{
    uint normal = workgroupIndex();
    if (normal >= kNormals)
        return;
    AliasSums carry = AliasSums(uint64_t(0), uint64_t(0), 0u, 0u);
    for (uint first = 0u; first < params.block_count; first += kAliasGroup)
    {
        uint block = first + gl_LocalInvocationIndex;
        AliasSums sums = AliasSums(uint64_t(0), uint64_t(0), 0u, 0u);
        if (block < params.block_count)
            sums = params.sums.data[normal * params.block_count + block];
        AliasSums total;
        AliasSums before = sumsBefore(sums, total);
        if (block < params.block_count)
            params.sums.data[normal * params.block_count + block] = add(carry, before);
        carry = add(carry, total);
    }
    if (gl_LocalInvocationIndex != 0u)
        return;
    params.sums.data[kNormals * params.block_count + normal] = carry;
    float heaviest = uintBitsToFloat(params.totals.data[0].heaviest[normal]);
    params.totals.data[0].irradiance[normal] = heaviest / float((1u << kWeightBits) - 1u) * float(totalOf(normal));
}
