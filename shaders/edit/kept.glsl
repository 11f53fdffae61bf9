// SPDX-License-Identifier: MIT
// Counts of kept elements (nodes, or words of voxels) in blocks of kScanBlock.
#ifndef ZVO_SHADERS_EDIT_KEPT_GLSL
#define ZVO_SHADERS_EDIT_KEPT_GLSL

#define SCAN_GROUP kScanGroup
#include "edit/compact.h"

GPU_ENTRY(EditSumParams, EDIT_SUM_CONSTANTS);
layout(local_size_x = kScanGroup) in;

// What is kept of a thread's elements from `first` on. No load waits for another, so all are under way.
void keptOfThread(uint first, out uint kept[kScanItems], out uint sum)
{
    sum = 0u;
    [[unroll]] for (uint i = 0u; i < kScanItems; ++i)
    {
        uint mark = params.marks.data[min(first + i, params.element_count - 1u)];
        mark = first + i < params.element_count ? mark : 0u;
        kept[i] = kVoxels ? bitCount(mark) : mark != 0u ? 1u : 0u;
        sum += kept[i];
    }
}

#endif
