// SPDX-License-Identifier: MIT
// Loads of half nodes and entries of lists for lib/traverse.glsl from a buffer of Node. main() sets g_halves first:
// read from the push constants inside of the traversal's loop, the address would be loaded again in every iteration.
#ifndef ZVO_SHADERS_LIB_OCTREE_HALF_GLSL
#define ZVO_SHADERS_LIB_OCTREE_HALF_GLSL

#include "lib/lists.glsl"

uint64_t_ConstPtr g_halves; // the nodes as 64-bit words, which lavapipe loads faster than pairs of 32-bit words

uvec2 loadHalf(uint half_index)
{
    return unpackUint2x32(g_halves.data[half_index]);
}

uint loadEntry(uint index, uint per_word)
{
    return listEntry(g_halves, index, per_word);
}

#endif
