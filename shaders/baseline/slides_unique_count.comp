#version 460
// SPDX-License-Identifier: MIT
// Counts different keys, and the nodes of each level above them: a voxel is the first one in all nodes of its path up to
// the highest one in which the voxel before it is not.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesUniqueParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#include "baseline/slides_leaders.glsl"
#include "lib/dispatch.glsl"

shared uint s_leaders[kSlidesLevels];

// The level above the voxels, of the highest node in which one of two voxels is the first.
uint highestNode(uint64_t differing)
{
    uvec2 words = unpackUint2x32(differing);
    int top = words.y != 0u ? 32 + findMSB(words.y) : findMSB(words.x);
    return min(uint(top) / 3u, params.depth);
}

void main()
{
    uint first = threadIndex() * kSlidesItems;
    if (gl_LocalInvocationIndex < kSlidesLevels)
        s_leaders[gl_LocalInvocationIndex] = 0u;
    barrier();
    SlidesCodes codes = loadCodes(params.keys, first, params.key_count);
    uint leaders = leadersOf(codes, first, params.key_count, 0u);
    uint64_t before = codes.before;
    [[unroll]] for (uint i = 0u; i < kSlidesItems; ++i)
    {
        if (((leaders >> i) & 1u) != 0u)
            atomicAdd(s_leaders[highestNode(codes.codes[i] ^ before)], 1u);
        before = codes.codes[i];
    }
    countKept(leaders, params.key_count, params.partials);
    barrier();
    if (gl_LocalInvocationIndex < kSlidesLevels && s_leaders[gl_LocalInvocationIndex] != 0u)
        atomicAdd(params.counters.data[0].leaders[gl_LocalInvocationIndex], s_leaders[gl_LocalInvocationIndex]);
}
