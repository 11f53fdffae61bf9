#version 460
// SPDX-License-Identifier: MIT
// Unique nodes, and words of their lists, in each block of kScanBlock candidates.
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
    ClassCountParams params;
};

void main()
{
    uint first = threadIndex() * kScanItems;
    uint nodes = 0u;
    uint entries = 0u;
    for (uint i = first; i < min(first + kScanItems, params.node_count); ++i)
    {
        bool unique = params.classes.data[i] == i;
        nodes += unique ? 1u : 0u;
        if (unique && i < params.inner_count)
            entries += childCount(params.nodes.data[i]);
    }
    uint node_total;
    uint entry_total;
    workgroupExclusiveAdd(nodes, node_total);
    workgroupExclusiveAdd(entries, entry_total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kScanBlock < params.node_count)
    {
        params.node_partials.data[workgroupIndex()] = node_total;
        params.entry_partials.data[workgroupIndex()] = entry_total;
    }
}
