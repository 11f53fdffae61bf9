#version 460
// SPDX-License-Identifier: MIT
// Keeps each key once, with the place of its first fragment.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesUniqueParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#include "baseline/slides_leaders.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint first = threadIndex() * kSlidesItems;
    SlidesCodes codes = loadCodes(params.keys, first, params.key_count);
    uint leaders = leadersOf(codes, first, params.key_count, 0u);
    uint place = placeOfKept(leaders, params.key_count, params.partials);
    [[unroll]] for (uint i = 0u; i < kSlidesItems; ++i)
        if (((leaders >> i) & 1u) != 0u)
        {
            params.codes.data[place] = codes.codes[i];
            params.firsts.data[place] = first + i;
            ++place;
        }
}
