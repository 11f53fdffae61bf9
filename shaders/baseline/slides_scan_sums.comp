#version 460
// SPDX-License-Identifier: MIT
// Sums up each block of kSlidesBlock values.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"
#define SCAN_GROUP kSlidesGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

layout(local_size_x = kSlidesGroup) in;
layout(push_constant, scalar) uniform Push
{
    SlidesScanParams params;
};

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
