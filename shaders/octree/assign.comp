#version 460
// SPDX-License-Identifier: MIT
// Sets the child bases of every node of a level from the prefix sum of child counts.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(AssignParams, GPU_NO_CONSTANTS);
layout(local_size_x = kAssignGroup) in;

#define SCAN_GROUP kAssignGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"
#include "octree/nodes.glsl"

// The children of the nodes of all blocks before this workgroup's.
uint childrenBefore()
{
    if (params.is_scanned != 0u)
        return params.partials.data[workgroupIndex()];
    uint sum = 0u;
    for (uint i = gl_LocalInvocationIndex; i < workgroupIndex(); i += kAssignGroup)
        sum += params.partials.data[i];
    uint total;
    workgroupExclusiveAdd(sum, total);
    return total;
}

// Four nodes that follow each other. Those past the end of the level are its last one, and have no children.
struct FourNodes
{
    bvec4 are_nodes;
    uvec4 nodes;
    uvec4 masks_lo;
    uvec4 counts; // of children
};

FourNodes loadNodes(uint first)
{
    FourNodes four;
    uvec4 indices = uvec4(first, first + 1u, first + 2u, first + 3u);
    four.are_nodes = lessThan(indices, uvec4(params.node_count));
    four.nodes = params.first_node + min(indices, uvec4(params.node_count - 1u));
    four.masks_lo = uvec4(params.nodes.data[four.nodes.x].mask_lo, params.nodes.data[four.nodes.y].mask_lo,
                          params.nodes.data[four.nodes.z].mask_lo, params.nodes.data[four.nodes.w].mask_lo);
    uvec4 masks_hi = uvec4(params.nodes.data[four.nodes.x].mask_hi, params.nodes.data[four.nodes.y].mask_hi,
                           params.nodes.data[four.nodes.z].mask_hi, params.nodes.data[four.nodes.w].mask_hi);
    four.counts = uvec4(bitCount(four.masks_lo) + bitCount(masks_hi)) * uvec4(four.are_nodes);
    return four;
}

uint childrenOf(FourNodes four)
{
    return four.counts.x + four.counts.y + four.counts.z + four.counts.w;
}

void setBases(FourNodes four, uint base)
{
    uvec3 bases = base + uvec3(four.counts.x, four.counts.x + four.counts.y, childrenOf(four) - four.counts.w);
    if (four.are_nodes.x)
        setBase(params.nodes, four.nodes.x, four.masks_lo.x, base);
    if (four.are_nodes.y)
        setBase(params.nodes, four.nodes.y, four.masks_lo.y, bases.x);
    if (four.are_nodes.z)
        setBase(params.nodes, four.nodes.z, four.masks_lo.z, bases.y);
    if (four.are_nodes.w)
        setBase(params.nodes, four.nodes.w, four.masks_lo.w, bases.z);
}

void main()
{
    if (workgroupIndex() * kScanBlock >= params.node_count)
        return;
    uint first = threadIndex() * kAssignItems;
    FourNodes low = loadNodes(first);
    FourNodes high = loadNodes(first + 4u);
    uint base = params.first_child + childrenBefore();
    uint total;
    base += workgroupExclusiveAdd(childrenOf(low) + childrenOf(high), total);
    setBases(low, base);
    setBases(high, base + childrenOf(low));
}
