#version 460
// SPDX-License-Identifier: MIT
// Sets the child bases of every touched node of a level from the prefix sum of child counts.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#include "lib/dispatch.glsl"
#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"

layout(local_size_x = kScanGroup) in;
layout(push_constant, scalar) uniform Push
{
    OverlayAssignParams params;
};

void main()
{
    OverlayLevel level = params.levels.data[params.level];
    uint first = threadIndex() * kScanItems;
    uint last = min(first + kScanItems, level.node_count);
    uint count_first = level.first_node - params.first_node;
    uint children = 0u;
    for (uint i = first; i < last; ++i)
        children += params.counts.data[count_first + i];
    uint total;
    uint base = workgroupExclusiveAdd(children, total);
    if (first >= last)
        return;
    bool are_leaves = params.level + 1u == params.level_count;
    base += params.partials.data[params.first_partial + workgroupIndex()];
    base += are_leaves ? params.first_voxel : level.first_node + level.node_count;
    for (uint i = first; i < last; ++i)
    {
        uint count = params.counts.data[count_first + i];
        if (count != 0u)
        {
            uint node = level.first_node + i;
            params.nodes.data[node].base_lo = base;
            params.nodes.data[node].base_hi = base + bitCount(params.nodes.data[node].mask_lo);
        }
        base += count;
    }
}
