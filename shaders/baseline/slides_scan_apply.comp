#version 460
// SPDX-License-Identifier: MIT
// Replaces each value by the sum of those before it: the scanned sum of the blocks before, and of those in its block.
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
