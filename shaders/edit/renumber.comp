#version 460
// SPDX-License-Identifier: MIT
// Counts the kept elements before each element.
#extension GL_GOOGLE_include_directive : require
#include "edit/kept.glsl"

void main()
{
    uint first = threadIndex() * kScanItems;
    uint last = min(first + kScanItems, params.element_count);
    uint kept = 0u;
    for (uint i = first; i < last; ++i)
        kept += keptIn(i);
    uint total;
    uint before = workgroupExclusiveAdd(kept, total);
    if (first < last)
        before += params.partials.data[workgroupIndex()];
    for (uint i = first; i < last; ++i)
    {
        params.numbers.data[i] = before;
        before += keptIn(i);
    }
}
