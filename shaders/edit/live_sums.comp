#version 460
// SPDX-License-Identifier: MIT
// Counts the elements of each block that are kept.
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
    workgroupExclusiveAdd(sum, total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kScanBlock < params.element_count)
        params.partials.data[workgroupIndex()] = total;
}
