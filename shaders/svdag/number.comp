#version 460
// SPDX-License-Identifier: MIT
// Numbers the unique nodes in the order of the candidates, and their lists likewise.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"
#define LISTS_CONSTANT_ID 0
#include "lib/dispatch.glsl"
#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"
#include "svdag/candidate.glsl"

layout(local_size_x = kScanGroup) in;
layout(push_constant, scalar) uniform Push
{
    ClassNumberParams params;
};

void main()
{
    uint first = threadIndex() * kScanItems;
    uint last = min(first + kScanItems, params.node_count);
    uint nodes = 0u;
    uint entries = 0u;
    for (uint i = first; i < last; ++i)
    {
        bool unique = params.classes.data[i] == i;
        nodes += unique ? 1u : 0u;
        if (unique && i < params.inner_count)
            entries += childCount(params.nodes.data[i]);
    }
    uint total;
    uint number = workgroupExclusiveAdd(nodes, total);
    uint entry = workgroupExclusiveAdd(entries, total);
    if (first < last)
    {
        number += params.node_partials.data[workgroupIndex()];
        entry += params.entry_partials.data[workgroupIndex()];
    }
    for (uint i = first; i < last; ++i)
    {
        bool unique = params.classes.data[i] == i;
        params.numbers.data[i] = number;
        if (i < params.inner_count)
        {
            params.first_entries.data[i] = entry;
            entry += unique ? childCount(params.nodes.data[i]) : 0u;
        }
        if (unique)
        {
            params.unique_nodes.data[number] = i;
            ++number;
        }
    }
}
