#version 460
// SPDX-License-Identifier: MIT
// Counts the kept elements before each element.
#extension GL_GOOGLE_include_directive : require
#include "edit/kept.glsl"
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

void main()
{
    uint first = threadIndex() * kScanItems;
    uint kept[kScanItems];
    uint sum;
    keptOfThread(first, kept, sum);
    uint total;
    uint before = workgroupExclusiveAdd(sum, total);
    if (first < params.element_count)
        before += params.partials.data[workgroupIndex()];
    [[unroll]] for (uint i = 0u; i < kScanItems; ++i)
    {
        if (first + i < params.element_count)
            params.numbers.data[first + i] = before;
        before += kept[i];
    }
}
