#version 460
// SPDX-License-Identifier: MIT
// Numbers the root and its children, in one workgroup, as octree/place and octree/assign do.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(NumberParams, OCTREE_NUMBER_CONSTANTS);
layout(local_size_x = kRootGroup) in;

#define SCAN_GROUP kRootGroup
#include "lib/scan.glsl"
#include "octree/nodes.glsl"
#include "octree/place.glsl"

// Numbers the nodes of a level, from first_node on. node_count: with full ones, which have no items.
void numberLevel(uint level, uint first_node, uint node_count)
{
    LevelRange range = params.ranges.data[params.level_count - 1u - level];
    bool is_node = gl_LocalInvocationIndex < node_count;
    uint children;
    if (gl_LocalInvocationIndex < range.count)
        placeNode(params.items.data[range.first + gl_LocalInvocationIndex], level == 0u, children);
    memoryBarrierBuffer();
    barrier();
    uint node = first_node + gl_LocalInvocationIndex;
    uvec2 masks = uvec2(0u);
    if (is_node)
        masks = uvec2(params.nodes.data[node].mask_lo, params.nodes.data[node].mask_hi);
    uint total;
    uint base = first_node + node_count + workgroupExclusiveAdd(bitCount(masks.x) + bitCount(masks.y), total);
    if (is_node)
        setBase(params.nodes, node, masks.x, base);
    memoryBarrierBuffer();
    barrier();
}

void main()
{
    numberLevel(0u, 0u, 1u);
    if (params.level_count > 1u)
        numberLevel(1u, 1u, params.root_children);
}
