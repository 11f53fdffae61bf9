#version 460
// SPDX-License-Identifier: MIT
// Counts the elements of each block that are kept.
#extension GL_GOOGLE_include_directive : require
#include "edit/kept.glsl"

void main()
{
    uint first = threadIndex() * kScanItems;
    uint kept = 0u;
    for (uint i = first; i < min(first + kScanItems, params.element_count); ++i)
        kept += keptIn(i);
    uint total;
    workgroupExclusiveAdd(kept, total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kScanBlock < params.element_count)
        params.partials.data[workgroupIndex()] = total;
}
