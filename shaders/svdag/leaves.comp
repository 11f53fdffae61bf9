#version 460
// SPDX-License-Identifier: MIT
// Writes the unique leaves.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(UniqueLeavesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    uint number = params.first_node + index;
    Node node = params.nodes.data[params.unique_nodes.data[number]];
    params.pool.data[number] = Node(node.mask_lo, 0u, node.mask_hi, bitCount(node.mask_lo));
}
