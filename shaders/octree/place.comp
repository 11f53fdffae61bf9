#version 460
// SPDX-License-Identifier: MIT
// Gives every node of a level its number: the parent's child base plus its rank among the parent's children. Until
// octree/assign runs, base_hi of the node holds its entry in the brick table.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#define BRICKS_CONSTANT_ID 0
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    PlaceParams params;
};

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    WorkItem item = params.items.data[params.first_item + index];
    BrickEntry brick = params.bricks.data[item.entry];
    uint node = 0u;
    if (params.is_root == 0u)
        node = childIndex(params.nodes.data[nodeOf(params.bricks.data[item.parent_entry])], brick.key & 63u);
    params.nodes.data[node] = Node(brick.mask_lo, 0u, brick.mask_hi, item.entry);
    if (kWideKeys)
        params.bricks.data[item.entry].mask_lo = node;
    else
        params.bricks.data[item.entry].base = node;
}
