// SPDX-License-Identifier: MIT
// What the kernels that merge equal nodes share. Needs GPU_ENTRY with SlidesClassParams.
#ifndef ZVO_SHADERS_BASELINE_SLIDES_CLASS_GLSL
#define ZVO_SHADERS_BASELINE_SLIDES_CLASS_GLSL

#include "baseline/slides.h"

layout(local_size_x = kSlidesGroup) in;

bool isFirstOfClass(uint candidate)
{
    return params.table.data[params.slots.data[candidate]] == candidate;
}

// Bit i: candidate first + i exists, and is the first of its class.
uint firstsOf(uint first)
{
    uint firsts = 0u;
    for (uint i = 0u; i < kSlidesItems; ++i)
        if (first + i < params.candidate_count && isFirstOfClass(first + i))
            firsts |= 1u << i;
    return firsts;
}

#endif
