#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the touched nodes of a level.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(OverlayAverageParams, UPDATE_AVERAGE_CONSTANTS);
layout(local_size_x_id = 1) in;

#include "lib/dispatch.glsl"

#define AVERAGE_CHILDREN Attribute_ConstPtr
#include "lib/average.glsl"

void main()
{
    LevelRange range = params.ranges.data[params.item_range];
    uint item = threadIndex() / kLanes;
    bool is_node = item < range.count && params.state.data[0].status.failed == 0u;
    uint index = 0u;
    Node node = Node(0u, 0u, 0u, 0u);
    if (is_node)
    {
        index = params.touched.data[params.items.data[range.first + item].entry].node;
        node = params.nodes.data[index];
        node.base_lo += params.children_offset;
    }
    Attribute mean = averageChildren(params.scene, node, params.children);
    if (is_node && laneOfNode() == 0u)
        params.averages.data[index + params.attribute_offset] = mean;
}
