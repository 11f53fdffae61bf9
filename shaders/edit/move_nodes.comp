#version 460
// SPDX-License-Identifier: MIT
// Copies the kept nodes to the new region.
#extension GL_GOOGLE_include_directive : require
#include "edit/compact.h"

GPU_ENTRY(EditMoveParams, EDIT_MOVE_NODES_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

// The new position of a run of children, or of a leaf's voxels; all of the run is kept.
uint movedNode(uint base)
{
    uint i = base - params.first_node;
    return i < params.node_count ? params.new_first_node + params.numbers.data[i] : base;
}

uint movedVoxel(uint base)
{
    uint i = base - params.first_voxel;
    if (i >= params.voxel_count)
        return base;
    uint below = params.voxel_bits.data[i >> 5] & ((1u << (i & 31u)) - 1u);
    return params.new_first_voxel + params.voxel_numbers.data[i >> 5] + bitCount(below);
}

void main()
{
    uint i = threadIndex();
    if (i >= params.node_count || params.marks.data[i] == 0u)
        return;
    uint from = params.first_node + i;
    uint to = params.new_first_node + params.numbers.data[i];
    uint level = params.marks.data[i] - 1u;
    Node node = params.nodes.data[from];
    if (level + 1u < params.level_count)
    {
        node.base_lo = movedNode(node.base_lo);
        node.base_hi = movedNode(node.base_hi);
    }
    else if (kAttributes && level + 1u == params.level_count)
    {
        node.base_lo = movedVoxel(node.base_lo);
        node.base_hi = movedVoxel(node.base_hi);
    }
    params.nodes.data[to] = node;
    if (kAttributes)
        params.node_attributes.data[to + params.attribute_offset] =
            params.node_attributes.data[from + params.attribute_offset];
    if (kRanks)
        params.ranks.data[to] = params.ranks.data[from];
}
