#version 460
// SPDX-License-Identifier: MIT
// Counts the parents of the cells of a level.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesParentsParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#include "baseline/slides_leaders.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint first = threadIndex() * kSlidesItems;
    SlidesCodes codes = loadCodes(params.codes, first, params.cell_count);
    countKept(leadersOf(codes, first, params.cell_count, 3u), params.cell_count, params.partials);
}
