#version 460
// SPDX-License-Identifier: MIT
// Copies the attributes of the kept voxels to the new region.
#extension GL_GOOGLE_include_directive : require
#include "edit/compact.h"

GPU_ENTRY(EditMoveParams, EDIT_MOVE_VOXELS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

void main()
{
    uint i = threadIndex();
    uint bit = 1u << (i & 31u);
    if (i >= params.voxel_count || (params.voxel_bits.data[i >> 5] & bit) == 0u)
        return;
    uint below = params.voxel_bits.data[i >> 5] & (bit - 1u);
    uint to = params.new_first_voxel + params.voxel_numbers.data[i >> 5] + bitCount(below);
    Attribute look = params.attributes.data[params.first_voxel + i];
    params.attributes.data[to] = look;
    if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
        atomicOr(params.emission_words.data[to >> 5].x, 1u << (to & 31u));
}
