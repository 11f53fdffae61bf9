#version 460
// SPDX-License-Identifier: MIT
// Writes the unique leaves, as leaf words unless the root is the leaf; of a filled tree, with their surface masks.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(UniqueLeavesParams, SVDAG_LEAVES_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"
#include "lib/node.glsl"

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    uint number = params.first_node + index;
    uvec2 mask = nodeMask(params.nodes, params.unique_nodes.data[number] + params.reference);
    if (kFilled)
    {
        uvec2 surface =
            nodeMask(params.nodes, params.unique_nodes.data[number] + params.reference + params.surface);
        params.pool.data[number] = Node(mask.x, mask.y, surface.x, surface.y);
    }
    else if (params.first_node == 0u)
        params.pool.data[0] = Node(mask.x, 0u, mask.y, bitCount(mask.x));
    else
        uint64_t_Ptr(uint64_t(params.pool)).data[params.first_node + number] = packUint2x32(mask);
}
