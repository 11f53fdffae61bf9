#version 460
// SPDX-License-Identifier: MIT
// Sets the child bases of every node of a level from the prefix sum of child counts. Where a leaf's entry in the brick
// table has room for it, the entry gets the number of the leaf's first voxel.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#include "lib/dispatch.glsl"
#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"

layout(local_size_x = kScanGroup) in;
layout(push_constant, scalar) uniform Push
{
    AssignParams params;
};

void main()
{
    uint first = threadIndex() * kScanItems;
    uint last = min(first + kScanItems, params.node_count);
    uint children = 0u;
    for (uint i = first; i < last; ++i)
    {
        Node node = params.nodes.data[params.first_node + i];
        children += bitCount(node.mask_lo) + bitCount(node.mask_hi);
    }
    uint total;
    uint base = params.first_child + workgroupExclusiveAdd(children, total);
    if (first < last)
        base += params.partials.data[workgroupIndex()];
    for (uint i = first; i < last; ++i)
    {
        Node node = params.nodes.data[params.first_node + i];
        uint entry = node.base_hi;
        node.base_lo = base;
        node.base_hi = base + bitCount(node.mask_lo);
        params.nodes.data[params.first_node + i] = node;
        if (params.tell_bricks != 0u)
            params.bricks.data[entry].base = base;
        base = node.base_hi + bitCount(node.mask_hi);
    }
}
