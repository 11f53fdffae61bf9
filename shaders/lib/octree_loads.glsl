// SPDX-License-Identifier: MIT
// lib/octree_half.glsl with a bound form (lib/bound.glsl), in which nodes and lists come from texels of params.nodes.
#ifndef ZVO_SHADERS_LIB_OCTREE_LOADS_GLSL
#define ZVO_SHADERS_LIB_OCTREE_LOADS_GLSL

#ifdef BOUND
#include "shared/svdag.h"

TEXELS_2(0, nodes);
uint64_t_ConstPtr g_halves; // main() sets it in both forms

uvec2 loadHalf(uint half_index)
{
    return texelFetch(texels2_nodes, int(half_index)).xy;
}

uint loadEntry(uint index, uint per_word)
{
    uvec2 word = loadHalf(index / per_word);
    uint place = index % per_word;
    if (per_word == 3u) // 21 bits each, the middle one in both halves
    {
        uint bits = place == 0u ? word.x : place == 1u ? (word.x >> 21) | (word.y << 11) : word.y >> 10;
        return bits & ((1u << (kListWordBits / 3u)) - 1u);
    }
    if (per_word == 4u)
        return bitfieldExtract(place < 2u ? word.x : word.y, int(16u * (place & 1u)), 16);
    return place == 0u ? word.x : word.y;
}
#else
#include "lib/octree_half.glsl"
#endif

#endif
