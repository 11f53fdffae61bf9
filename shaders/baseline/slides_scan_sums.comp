#version 460
// SPDX-License-Identifier: MIT
// Sums up each block of kSlidesBlock values.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesScanParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#define SCAN_GROUP kSlidesGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

void main()
{
    uint first = threadIndex() * kSlidesItems;
    uint sum = 0u;
    for (uint i = first; i < min(first + kSlidesItems, params.count); ++i)
        sum += params.values.data[i];
    uint total;
    workgroupExclusiveAdd(sum, total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kSlidesBlock < params.count)
        params.partials.data[workgroupIndex()] = total;
}
