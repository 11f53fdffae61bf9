#version 460
// SPDX-License-Identifier: MIT
// Sets the states of the slots in the new region, with the ends of their copies there.
#extension GL_GOOGLE_include_directive : require
#include "edit/compact.h"

GPU_ENTRY(EditMoveStatesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

// Number of kept nodes before node i of the old region; i may be one past its last.
uint nodesBefore(uint i)
{
    uint last = min(i, params.node_count) - 1u; // slot 0 has at least its root before
    return params.numbers.data[last] + (i > last && params.marks.data[last] != 0u ? 1u : 0u);
}

uint voxelsBefore(uint i)
{
    if (i == 0u || params.voxel_count == 0u)
        return 0u;
    uint last = min(i, params.voxel_count) - 1u;
    uint up_to_last = params.voxel_bits.data[last >> 5] & (~0u >> (31u - (last & 31u)));
    return params.voxel_numbers.data[last >> 5] + bitCount(up_to_last);
}

void main()
{
    uint slot = threadIndex();
    if (slot >= params.slot_count)
        return;
    EditState state = params.states.data[slot];
    state.node_top = params.new_first_node + nodesBefore(state.node_top - params.first_node);
    state.voxel_top = params.new_first_voxel + voxelsBefore(state.voxel_top - params.first_voxel);
    params.new_states.data[slot] = state;
}
