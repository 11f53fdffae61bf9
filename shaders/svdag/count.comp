#version 460
// SPDX-License-Identifier: MIT
// Unique nodes, and words of their lists, in each block of kScanBlock candidates.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(ClassCountParams, SVDAG_COUNT_CONSTANTS);
layout(local_size_x = kScanGroup) in;

#define SCAN_GROUP kScanGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"
#include "svdag/candidate.glsl"

void main()
{
    uint first = threadIndex() * kScanItems;
    UniqueCandidates unique =
        uniqueCandidates(params.classes, params.nodes, first, params.node_count, params.inner_count);
    uint entries = 0u;
    [[unroll]] for (uint i = 0u; i < kScanItems; ++i)
        entries += unique.entry_counts[i];
    uint node_total;
    uint entry_total;
    workgroupExclusiveAdd(uint(bitCount(unique.nodes)), node_total);
    workgroupExclusiveAdd(entries, entry_total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kScanBlock < params.node_count)
    {
        params.node_partials.data[workgroupIndex()] = node_total;
        params.entry_partials.data[workgroupIndex()] = entry_total;
    }
}
