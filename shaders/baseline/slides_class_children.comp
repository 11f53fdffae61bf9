#version 460
// SPDX-License-Identifier: MIT
// Gives each candidate the number of the node that its class became.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesClassParams, GPU_NO_CONSTANTS);

#include "baseline/slides_class.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint candidate = threadIndex();
    if (candidate < params.candidate_count)
        params.parent_nodes.data[candidate] = params.numbers.data[params.table.data[params.slots.data[candidate]]];
}
