#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the root's children, then of the root: one workgroup, kLanes threads a node.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(AverageTopParams, OCTREE_AVERAGE_TOP_CONSTANTS);
layout(local_size_x_id = 1) in;

#include "lib/node.glsl"

#define AVERAGE_CHILDREN Attribute_Ptr
#include "lib/average.glsl"

void averageLevel(uint level, Attribute_Ptr children)
{
    LevelRange nodes = params.levels[level];
    uint index = nodes.first + nodeOfGroup();
    bool is_node = nodeOfGroup() < nodes.count;
    Node node = Node(0u, 0u, 0u, 0u);
    if (is_node)
    {
        node = loadNodeOf(params.nodes, params.leaf_groups,
                          index + (level == params.leaf_level ? params.leaf_reference : 0u));
        node.base_lo -= level + 1u == params.leaf_level ? params.leaf_reference : 0u;
    }
    Attribute mean = averageChildren(params.scene, node, children);
    if (is_node && laneOfNode() == 0u)
        params.averages.data[index] = mean;
}

void main()
{
    bool has_children = params.level_count == kRootLevels;
    if (has_children)
    {
        averageLevel(1u, Attribute_Ptr(uint64_t(params.lowest_children)));
        memoryBarrierBuffer();
        barrier();
    }
    averageLevel(0u, Attribute_Ptr(has_children ? uint64_t(params.averages) : uint64_t(params.lowest_children)));
}
