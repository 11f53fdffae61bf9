#version 460
// SPDX-License-Identifier: MIT
// Gives every node of a level below the root its number, and counts the children of each block of kScanBlock nodes.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(PlaceParams, OCTREE_PLACE_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"
#include "octree/place.glsl"

void main()
{
    uint index = threadIndex();
    if (index >= params.item_count)
        return;
    uint children;
    uint node = placeNode(params.items.data[params.first_item + index], false, children);
    atomicAdd(params.partials.data[(node - params.first_node) / kScanBlock], children);
}
