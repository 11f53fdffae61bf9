#version 460
// SPDX-License-Identifier: MIT
// Copies attributes of an octree's nodes from breadth-first to depth-first order, for the children of a level's nodes.
// Levels go from the root down; the root's rank is 0.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"
#include "lib/dispatch.glsl"

layout(constant_id = 0) const uint kEntriesPerWord = 0u; // of candidates' lists; 0: there are none
layout(constant_id = 1) const bool kAboveLeaves = false; // the children are leaves
layout(constant_id = 2) const bool kPacked = false;      // attributes are words
layout(constant_id = 3) const uint kLanes = 1u;          // threads that share a node, a power of two

layout(local_size_x = kSvdagGroup) in;
layout(push_constant, scalar) uniform Push
{
    DepthFirstParams params;
};

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
        uint child = childIndexAfter(node, i);
        uint child_rank = rank + 1u + (kAboveLeaves ? i : params.before.data[first_entry + i].nodes);
        if (kAboveLeaves)
            moveAttribute(child, child_rank);
        else
            params.ranks.data[child] = child_rank;
    }
}
