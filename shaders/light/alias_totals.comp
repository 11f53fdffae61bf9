#version 460
// SPDX-License-Identifier: MIT
// Sums up the weights of a normal: the lower and the upper halves of their bits apart, so that sums have 32 bits.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"
#include "lib/dispatch.glsl"

layout(local_size_x = kAliasGroup) in;
layout(push_constant, scalar) uniform Push
{
    AliasParams params;
};

#include "light/alias.glsl"

shared uint s_low;
shared uint s_high;

void main()
{
    uint group = workgroupIndex();
    uint normal = group / params.block_count;
    if (normal >= kNormals)
        return;
    if (gl_LocalInvocationIndex == 0u)
    {
        s_low = 0u;
        s_high = 0u;
    }
    barrier();
    uint first = (group % params.block_count) * kAliasBlock + gl_LocalInvocationIndex;
    uint low = 0u;
    uint high = 0u;
    for (uint k = 0u; k < kAliasItems; ++k)
    {
        uint i = first + k * kAliasGroup;
        uint weight = i < params.cell_count ? weightOf(normal, min(i, params.cell_count - 1u)) : 0u;
        low += weight & ((1u << (kWeightBits / 2u)) - 1u);
        high += weight >> (kWeightBits / 2u);
    }
    atomicAdd(s_low, low);
    atomicAdd(s_high, high);
    barrier();
    if (gl_LocalInvocationIndex != 0u)
        return;
    atomicAdd(params.totals.data[0].low_sums[normal], s_low);
    atomicAdd(params.totals.data[0].high_sums[normal], s_high);
}
