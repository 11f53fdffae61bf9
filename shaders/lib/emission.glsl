// SPDX-License-Identifier: MIT
// The emission table: words of 32 voxels, each with the bits of those that emit and the index of the first one's value.
#ifndef ZVO_SHADERS_LIB_EMISSION_GLSL
#define ZVO_SHADERS_LIB_EMISSION_GLSL

#include "shared/gpu.h"

// Where the value of an emissive voxel stands.
uint emissionIndex(uvec2_ConstPtr words, uint voxel)
{
    uvec2 word = words.data[voxel >> 5];
    return word.y + bitCount(word.x & ((1u << (voxel & 31u)) - 1u));
}

#endif
