#version 460
// SPDX-License-Identifier: MIT
// Marks the children, or the voxels of leaves, of the kept nodes of a level, as far as they stand in the region.
#extension GL_GOOGLE_include_directive : require
#include "edit/compact.h"

GPU_ENTRY(EditMarkParams, EDIT_MARK_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

// Several threads may mark the same node; they write the same, because a node has one level.
void markNodes(uint base, uint count)
{
    if (base - params.first_node >= params.node_count) // or less than first_node
        return;
    for (uint k = 0u; k < count; ++k)
        params.marks.data[base - params.first_node + k] = params.level + 2u;
}

void markVoxels(uint base, uint count)
{
    uint first = base - params.first_voxel;
    if (first >= params.voxel_count || count == 0u)
        return;
    uint bits = ~0u >> (32u - count);
    uint shift = first & 31u;
    atomicOr(params.voxel_bits.data[first >> 5], bits << shift);
    if (shift + count > 32u)
        atomicOr(params.voxel_bits.data[(first >> 5) + 1u], bits >> (32u - shift));
}

void main()
{
    uint i = threadIndex();
    if (i >= params.node_count || params.marks.data[i] != params.level + 1u)
        return;
    Node node = params.nodes.data[params.first_node + i];
    if (kLeaves)
    {
        markVoxels(node.base_lo, bitCount(node.mask_lo));
        markVoxels(node.base_hi, bitCount(node.mask_hi));
    }
    else
    {
        markNodes(node.base_lo, bitCount(node.mask_lo));
        markNodes(node.base_hi, bitCount(node.mask_hi));
    }
}
