#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the root's touched children, then of the root: one workgroup, kLanes threads a node.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(OverlayAverageTopParams, UPDATE_AVERAGE_TOP_CONSTANTS);
layout(local_size_x_id = 1) in;

#define AVERAGE_CHILDREN Attribute_Ptr
#include "lib/average.glsl"

void averageLevel(LevelRange range, Attribute_Ptr children, uint children_offset)
{
    bool is_node = nodeOfGroup() < range.count && params.state.data[0].status.failed == 0u;
    uint index = 0u;
    Node node = Node(0u, 0u, 0u, 0u);
    if (is_node)
    {
        index = params.touched.data[params.items.data[range.first + nodeOfGroup()].entry].node;
        node = params.nodes.data[index];
        node.base_lo += children_offset;
    }
    Attribute mean = averageChildren(params.scene, node, children);
    if (is_node && laneOfNode() == 0u)
        params.averages.data[index + params.attribute_offset] = mean;
}

void main()
{
    bool has_children = params.level_count >= kRootLevels;
    if (has_children)
    {
        averageLevel(params.ranges.data[params.level_count - 2u], Attribute_Ptr(uint64_t(params.lowest_children)),
                     params.lowest_offset);
        memoryBarrierBuffer();
        barrier();
    }
    averageLevel(params.ranges.data[params.level_count - 1u],
                 Attribute_Ptr(has_children ? uint64_t(params.averages) : uint64_t(params.lowest_children)),
                 has_children ? params.attribute_offset : params.lowest_offset);
}
