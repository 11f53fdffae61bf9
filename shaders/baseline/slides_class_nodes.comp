#version 460
// SPDX-License-Identifier: MIT
// Makes a node of the first candidate of each class.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesClassParams, BASELINE_SLIDES_CLASS_NODES_CONSTANTS);

#include "baseline/slides_class.glsl"
#include "baseline/slides_leaders.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint first = threadIndex() * kSlidesItems;
    uint firsts = firstsOf(first);
    uint number = placeOfKept(firsts, params.candidate_count, params.partials);
    for (uint level = 0u; level < params.level; ++level)
        number += params.counters.data[0].node_counts[level];
    for (; firsts != 0u; firsts &= firsts - 1u)
    {
        uint candidate = first + uint(findLSB(firsts));
        for (uint i = 0u; i < kNodeWords; ++i)
            params.nodes.data[number * kNodeWords + i] = params.candidates.data[candidate * kNodeWords + i];
        params.numbers.data[candidate] = number;
        ++number;
    }
}
