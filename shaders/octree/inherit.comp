#version 460
// SPDX-License-Identifier: MIT
// Gives the children of a level's nodes that have no voxel of the surface the colours of their parents: of the lowest
// node around them that has one. Their normal stays none.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(InheritParams, GPU_NO_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

void main()
{
    if (threadIndex() >= params.node_count)
        return;
    uint number = params.first_node + threadIndex();
    Node node = params.nodes.data[number];
    uint color = params.attributes.data[number].color & kColorMask;
    uint end = node.base_lo + bitCount(node.mask_lo) + bitCount(node.mask_hi);
    for (uint child = node.base_lo; child < end; ++child)
        if ((params.attributes.data[child].color & (kAttributeNone << 24)) != 0u)
            params.attributes.data[child].color = color;
}
