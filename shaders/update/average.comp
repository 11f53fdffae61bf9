#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the touched nodes of a level.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#include "lib/average.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    OverlayAverageParams params;
};

void main()
{
    LevelRange range = params.ranges.data[params.item_range];
    uint item = threadIndex();
    if (item >= range.count || params.status.data[0].failed != 0u)
        return;
    uint index = params.touched.data[params.items.data[range.first + item].entry].node;
    Node node = params.nodes.data[index];
    node.base_lo += params.children_offset;
    params.averages.data[index + params.attribute_offset] = averageChildren(params.scene, node, params.children);
}
