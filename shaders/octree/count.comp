#version 460
// SPDX-License-Identifier: MIT
// Counts the children of each block of kScanBlock nodes.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#include "lib/dispatch.glsl"
#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"

layout(local_size_x = kScanGroup) in;
layout(push_constant, scalar) uniform Push
{
    CountParams params;
};

void main()
{
    uint first = threadIndex() * kScanItems;
    uint children = 0u;
    for (uint i = first; i < min(first + kScanItems, params.node_count); ++i)
    {
        Node node = params.nodes.data[params.first_node + i];
        children += bitCount(node.mask_lo) + bitCount(node.mask_hi);
    }
    uint total;
    workgroupExclusiveAdd(children, total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kScanBlock < params.node_count)
        params.partials.data[workgroupIndex()] = total;
}
