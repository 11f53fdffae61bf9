#version 460
// SPDX-License-Identifier: MIT
// Computes the attribute of each node of a level: the mean of its children's, with equal weights.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#include "lib/average.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    AverageParams params;
};

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    uint node = params.first_node + index;
    params.averages.data[node] = averageChildren(params.scene, params.nodes.data[node], params.children);
}
