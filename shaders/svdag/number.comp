#version 460
// SPDX-License-Identifier: MIT
// Numbers the unique nodes in the order of the candidates, and their lists in the same order.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(ClassNumberParams, SVDAG_NUMBER_CONSTANTS);
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
    uint total;
    uint number = workgroupExclusiveAdd(uint(bitCount(unique.nodes)), total);
    uint entry = workgroupExclusiveAdd(entries, total);
    if (first < params.node_count)
    {
        number += params.node_partials.data[workgroupIndex()];
        entry += params.entry_partials.data[workgroupIndex()];
    }
    [[unroll]] for (uint i = 0u; i < kScanItems; ++i)
    {
        uint candidate = first + i;
        if (candidate < params.node_count)
            params.numbers.data[candidate] = number;
        if (candidate < params.inner_count)
            params.first_entries.data[candidate] = entry;
        entry += unique.entry_counts[i];
        if (((unique.nodes >> i) & 1u) != 0u)
        {
            params.unique_nodes.data[number] = candidate;
            ++number;
        }
    }
}
