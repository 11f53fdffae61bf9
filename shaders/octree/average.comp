#version 460
// SPDX-License-Identifier: MIT
// Computes the attribute of each node of a level: the mean of its children's, with equal weights.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(AverageParams, OCTREE_AVERAGE_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"

#define AVERAGE_CHILDREN Attribute_ConstPtr
#define CHILDREN_BINDING 0
#define COLOR_BINDING 1
#include "lib/average.glsl"

void main()
{
    uint index = threadIndex() / kLanes;
    bool is_node = index < params.node_count;
    Node node = Node(0u, 0u, 0u, 0u);
    if (is_node)
    {
        node = loadNodeOf(params.nodes, params.leaf_groups, params.first_node + index + params.reference);
        node.base_lo -= params.child_reference;
    }
    Attribute mean = averageChildren(params.scene, node, params.children);
    if (is_node && laneOfNode() == 0u)
        params.averages.data[params.first_node + index] = mean;
}
