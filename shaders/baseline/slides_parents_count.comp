#version 460
// SPDX-License-Identifier: MIT
// Counts the parents of the cells of a level.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"
#include "baseline/slides_leaders.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kSlidesGroup) in;
layout(push_constant, scalar) uniform Push
{
    SlidesParentsParams params;
};

void main()
{
    uint first = threadIndex() * kSlidesItems;
    SlidesCodes codes = loadCodes(params.codes, first, params.cell_count);
    countKept(leadersOf(codes, first, params.cell_count, 3u), params.cell_count, params.partials);
}
