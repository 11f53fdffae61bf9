#version 460
// SPDX-License-Identifier: MIT
// Tells the children of a level's nodes where they stand.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(PlacesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "algebra/place.glsl"
#include "lib/cell_masks.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

void main()
{
    if (threadIndex() >= params.node_count)
        return;
    uint number = params.first_node + threadIndex();
    NodePlace place = unpackPlace(params.places.data[number]);
    Node node = params.nodes.data[number];
    uvec2 rest = uvec2(node.mask_lo, node.mask_hi);
    if (uint64_t(params.leaf_groups) != 0ul && isFullNode(node.base_lo))
        rest = uvec2(0u); // its children are shared
    for (; (rest.x | rest.y) != 0u;)
    {
        uint cell = firstCell(rest);
        rest &= ~cellBit(cell);
        uint child = nodeIndexOf(params.leaf_groups, childIndex(node, cell));
        params.places.data[child] = packPlace(NodePlace(4u * place.cell + cellNumbered(cell), place.level + 1u));
    }
}
