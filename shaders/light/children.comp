#version 460
// SPDX-License-Identifier: MIT
// Lists the children with emissive voxels of each node of a level: a thread for each cell.
#extension GL_GOOGLE_include_directive : require
#include "light/light_tree.h"

GPU_ENTRY(LightChildrenParams, LIGHT_CHILDREN_CONSTANTS);
layout(local_size_x = kLightGroup) in;

#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ranks.glsl"
#include "light/item.glsl"

void main()
{
    LightLevel level = params.levels.data[params.level];
    uint item = workgroupIndex();
    if (item >= level.count || params.levels.data[params.level + 1u].count == 0u)
        return;
    uint cell = gl_LocalInvocationIndex;
    LightNode node = params.nodes.data[level.first + item];
    Node emissive = Node(node.mask_lo, node.first_child, node.mask_hi, node.first_child + bitCount(node.mask_lo));
    if (!hasChild(emissive, cell))
        return;
    LightItem at = params.items.data[level.first + item];
    bool direct;
    RankedNode child = childOf(RankedNode(at.node, at.voxels, at.rank), cell, params.level + 2u == kNodeLevels, direct);
    params.items.data[childIndex(emissive, cell)] =
        LightItem(child.node, child.voxels, child.rank, 4u * at.cell + mortonDecode(cell), vec3(0.0), vec3(0.0));
}
