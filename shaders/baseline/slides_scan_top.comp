#version 460
// SPDX-License-Identifier: MIT
// Exclusive prefix sum in place, by one workgroup that walks over the values.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesScanTopParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#define SCAN_GROUP kSlidesGroup
#include "lib/scan.glsl"

void main()
{
    uint carry = 0u;
    bool wrapped = false;
    for (uint first = 0u; first < params.count; first += kSlidesBlock)
    {
        uint values[kSlidesItems];
        uint sum = 0u;
        [[unroll]] for (uint i = 0u; i < kSlidesItems; ++i)
        {
            uint at = first + gl_LocalInvocationIndex * kSlidesItems + i;
            values[i] = at < params.count ? params.values.data[at] : 0u;
            sum += values[i];
        }
        uint total;
        uint before = carry + workgroupExclusiveAdd(sum, total);
        [[unroll]] for (uint i = 0u; i < kSlidesItems; ++i)
        {
            uint at = first + gl_LocalInvocationIndex * kSlidesItems + i;
            if (at < params.count)
                params.values.data[at] = before;
            before += values[i];
        }
        wrapped = wrapped || carry + total < carry;
        carry += total;
    }
    if (gl_LocalInvocationIndex == 0u)
        params.total.data[0] = wrapped ? kSlidesTooMany : carry;
}
