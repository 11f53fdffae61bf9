#version 460
// SPDX-License-Identifier: MIT
// Rounds the weights of a normal to steps, and sums them up: the lower and the upper halves of their bits apart, so
// that sums have 32 bits.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"

GPU_ENTRY(AliasParams, GPU_NO_CONSTANTS);
layout(local_size_x = kAliasGroup) in;

#include "lib/dispatch.glsl"

// A weight in steps.
uint stepsOf(float weight, float heaviest)
{
    const uint steps = (1u << kWeightBits) - 1u;
    uint rounded = uint(weight / max(heaviest, kSmallestFloat) * float(steps) + 0.5);
    return weight > 0.0 ? clamp(rounded, 1u, steps) : 0u;
}

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
    float heaviest = uintBitsToFloat(params.totals.data[0].heaviest[normal]);
    uint first = (group % params.block_count) * kAliasBlock + gl_LocalInvocationIndex;
    uint low = 0u;
    uint high = 0u;
    for (uint k = 0u; k < kAliasItems; ++k)
    {
        uint i = first + k * kAliasGroup;
        if (i < params.cell_count)
        {
            uint cell = normal * params.cell_count + i;
            uint weight = stepsOf(uintBitsToFloat(params.weights.data[cell]), heaviest);
            params.weights.data[cell] = weight;
            low += weight & ((1u << (kWeightBits / 2u)) - 1u);
            high += weight >> (kWeightBits / 2u);
        }
    }
    atomicAdd(s_low, low);
    atomicAdd(s_high, high);
    barrier();
    if (gl_LocalInvocationIndex != 0u)
        return;
    atomicAdd(params.totals.data[0].low_sums[normal], s_low);
    atomicAdd(params.totals.data[0].high_sums[normal], s_high);
}
