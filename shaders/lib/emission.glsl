// SPDX-License-Identifier: MIT
// Emission of voxels (shared/tree_table.h): words of 32 voxels, each with the bits of those that emit and the index of
// the first one's value.
#ifndef ZVO_SHADERS_LIB_EMISSION_GLSL
#define ZVO_SHADERS_LIB_EMISSION_GLSL

#include "lib/color.glsl"
#include "shared/tree_table.h"

// Whether a voxel emits light: none does that is inside.
bool isEmissive(uvec2_ConstPtr words, uint voxel)
{
    if (voxel >= kInteriorIndex)
        return false;
    return ((words.data[voxel >> 5].x >> (voxel & 31u)) & 1u) != 0u;
}

// Where the value of an emissive voxel stands.
uint emissionIndex(uvec2_ConstPtr words, uint voxel)
{
    uvec2 word = words.data[voxel >> 5];
    return word.y + bitCount(word.x & ((1u << (voxel & 31u)) - 1u));
}

// The radiance of an emissive voxel, by the index of its attributes.
vec3 emissionOf(TreeTable_ConstPtr tree, uint voxel)
{
    uvec2_ConstPtr words = tree.data[0].emission_words;
    uint index = emissionIndex(words, voxel);
    return tree.data[0].emission_scale * decodeRgb9e5(tree.data[0].emission.data[index]);
}

#endif
