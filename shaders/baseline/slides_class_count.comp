#version 460
// SPDX-License-Identifier: MIT
// Counts classes by their first candidates.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesClassParams, GPU_NO_CONSTANTS);

#include "baseline/slides_class.glsl"
#include "baseline/slides_leaders.glsl"
#include "lib/dispatch.glsl"

void main()
{
    countKept(firstsOf(threadIndex() * kSlidesItems), params.candidate_count, params.partials);
}
