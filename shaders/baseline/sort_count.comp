#version 460
// SPDX-License-Identifier: MIT
// Counts the keys of each block by their digit.
#extension GL_GOOGLE_include_directive : require
#include "baseline/sort.h"

GPU_ENTRY(SortCountParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSortGroup) in;

#include "lib/dispatch.glsl"

shared uint s_counts[kSortDigits];

void main()
{
    uint block = workgroupIndex();
    if (block >= params.block_count)
        return;
    for (uint digit = gl_LocalInvocationIndex; digit < kSortDigits; digit += kSortGroup)
        s_counts[digit] = 0u;
    barrier();
    for (uint i = 0u; i < kSortItems; ++i)
    {
        uint at = block * kSortBlock + i * kSortGroup + gl_LocalInvocationIndex;
        if (at < params.key_count)
            atomicAdd(s_counts[uint(params.keys.data[at] >> params.shift) & (kSortDigits - 1u)], 1u);
    }
    barrier();
    for (uint digit = gl_LocalInvocationIndex; digit < kSortDigits; digit += kSortGroup)
        params.counts.data[digit * params.block_count + block] = s_counts[digit];
}
