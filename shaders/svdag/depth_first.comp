#version 460
// SPDX-License-Identifier: MIT
// Copies attributes of an octree's nodes from breadth-first to depth-first order, for the children of a level's nodes.
// Levels go from the root down; the root's rank is 0.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(DepthFirstParams, SVDAG_DEPTH_FIRST_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"
#include "svdag/candidate.glsl"

void moveAttribute(uint from, uint to)
{
    if (kPacked)
        uint_Ptr(uint64_t(params.to)).data[to] = uint_ConstPtr(uint64_t(params.from)).data[from];
    else
        params.to.data[to] = params.from.data[from];
}

void main()
{
    uint index = threadIndex() / kLanes;
    uint lane = gl_LocalInvocationIndex % kLanes;
    if (index >= params.node_count)
        return;
    uint self = params.first_node + index;
    Node node = params.nodes.data[self];
    uint count = childCount(node);
    uint rank = params.ranks.data[self];
    if (lane == 0u)
        moveAttribute(self, rank);
    uint first_entry = params.first_entries.data[params.classes.data[self]];
    for (uint i = lane; i < count; i += kLanes)
    {
        uint child = childIndexAfter(node, i) - params.child_reference;
        uint child_rank = rank + 1u + (kAboveLeaves ? i : params.before.data[first_entry + i].nodes);
        if (kAboveLeaves)
            moveAttribute(child, child_rank);
        else
            params.ranks.data[child] = child_rank;
    }
}
