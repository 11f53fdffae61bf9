#version 460
// SPDX-License-Identifier: MIT
// Sets the child bases of every touched node of a level from the prefix sum of child counts.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(OverlayAssignParams, GPU_NO_CONSTANTS);
layout(local_size_x = kScanGroup) in;

#define SCAN_GROUP kScanGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

void main()
{
    OverlayLevel level = params.state.data[0].levels[params.level];
    uint first = threadIndex() * kScanItems;
    uint node_count = max(level.node_count, 1u);
    uint counts[kScanItems];
    uint middles[kScanItems]; // children in the lower halves of the nodes
    uint children = 0u;
    [[unroll]] for (uint i = 0u; i < kScanItems; ++i) // no load waits for a condition, so many are under way
    {
        uint node = level.first_node + min(first + i, node_count - 1u);
        uint count = params.counts.data[node - params.first_node];
        middles[i] = bitCount(params.nodes.data[node].mask_lo);
        counts[i] = first + i < level.node_count ? count : 0u;
        children += counts[i];
    }
    uint total;
    uint base = workgroupExclusiveAdd(children, total);
    if (first >= level.node_count)
        return;
    bool are_leaves = params.level + 1u == params.state.data[0].level_count;
    base += params.partials.data[params.first_partial + workgroupIndex()];
    base += are_leaves ? params.first_voxel : level.first_node + level.node_count;
    [[unroll]] for (uint i = 0u; i < kScanItems; ++i)
    {
        if (counts[i] != 0u)
        {
            uint node = level.first_node + first + i;
            params.nodes.data[node].base_lo = base;
            params.nodes.data[node].base_hi = base + middles[i];
        }
        base += counts[i];
    }
}
