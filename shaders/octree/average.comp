#version 460
// SPDX-License-Identifier: MIT
// What a node looks like from afar: the mean of its occupied children, all weighted alike.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#include "lib/attribute.glsl"
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
    Node node = params.nodes.data[params.first_node + index];
    uint count = bitCount(node.mask_lo) + bitCount(node.mask_hi);
    uvec3 color = uvec3(0u);
    ivec3 normal = ivec3(0);
    uint flags = 0u;
    for (uint i = 0u; i < count; ++i) // children stand one behind the other
    {
        Attribute child = params.children.data[node.base_lo + i];
        color += unpackColor(params.scene, child.color);
        normal += decodeNormal(child.normal);
        flags |= child.color >> 24;
    }
    color = divideSmall(color + count / 2u, count);
    params.averages.data[params.first_node + index] = Attribute(packColor(params.scene, color, flags), encodeNormal(normal));
}
