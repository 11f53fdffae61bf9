#version 460
// SPDX-License-Identifier: MIT
// Copies the emission of the kept voxels to the new region.
#extension GL_GOOGLE_include_directive : require
#include "edit/compact.h"

GPU_ENTRY(EditMoveEmissionParams, GPU_NO_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"
#include "lib/emission.glsl"

void main()
{
    uint i = threadIndex();
    uint bit = 1u << (i & 31u);
    uint from = params.first_voxel + i;
    if (i >= params.voxel_count || (params.voxel_bits.data[i >> 5] & bit) == 0u ||
        (params.emission_words.data[from >> 5].x & (1u << (from & 31u))) == 0u)
        return;
    uint below = params.voxel_bits.data[i >> 5] & (bit - 1u);
    uint to = params.new_first_voxel + params.voxel_numbers.data[i >> 5] + bitCount(below);
    params.emission.data[emissionIndex(params.emission_words, to)] =
        params.emission.data[emissionIndex(params.emission_words, from)];
}
