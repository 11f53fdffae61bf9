#version 460
// SPDX-License-Identifier: MIT
// Replaces each value by the sum of those before it: the scanned sum of the blocks before, and of those in its block.
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
    uint last = min(first + kSlidesItems, params.count);
    uint sum = 0u;
    for (uint i = first; i < last; ++i)
        sum += params.values.data[i];
    uint total;
    uint before = workgroupExclusiveAdd(sum, total);
    if (first < last)
        before += params.partials.data[workgroupIndex()];
    for (uint i = first; i < last; ++i)
    {
        uint value = params.values.data[i];
        params.values.data[i] = before;
        before += value;
    }
}
