// SPDX-License-Identifier: MIT
// Half nodes and leaf words, entries of lists, and leaf groups, as lib/traverse.glsl and trace/beam_start.glsl load
// them. main() sets g_halves and, where indices of voxels are wanted, g_leaf_groups in both forms of a kernel: read
// from the push constants inside of a traversal's loop, the address would be loaded again in every iteration.
// NODES_BINDING (optional): the binding of params.nodes in the kernel's bound form (lib/bound.glsl).
// GROUPS_BINDING (optional, with the one before): that of params.leaf_groups; GROUPS_BINDING + 1 is that of params.nodes
// in texels of four words.
#ifndef ZVO_SHADERS_LIB_HALF_NODE_GLSL
#define ZVO_SHADERS_LIB_HALF_NODE_GLSL

#include "lib/bound.glsl"
#include "lib/node.glsl"
#include "shared/svdag.h"

uint64_t_ConstPtr g_halves; // the nodes as 64-bit words, which lavapipe loads faster than pairs of 32-bit words
uint64_t_ConstPtr g_leaf_groups; // of an octree, as 64-bit words

#if defined(BOUND) && defined(NODES_BINDING)
TEXELS_2(NODES_BINDING, nodes);

// Mask and base of half `half_index & 1` of node `half_index >> 1`, or the masks of leaf word half_index.
uvec2 loadHalf(uint half_index)
{
    return texelFetch(texels2_nodes, int(half_index)).xy;
}

// The entry of a list with an index.
uint loadEntry(uint index, uint per_word)
{
    per_word &= ~kFilledDag;
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
uvec2 loadHalf(uint half_index)
{
    return unpackUint2x32(g_halves.data[half_index]);
}

uint loadEntry(uint index, uint per_word)
{
    return listEntry(g_halves, index, per_word);
}
#endif

#if defined(BOUND) && defined(GROUPS_BINDING)
TEXELS_2(GROUPS_BINDING, leaf_groups);
TEXELS_4(GROUPS_BINDING + 1, nodes);

uvec2 loadLeafGroup(uint i)
{
    return texelFetch(texels2_leaf_groups, int(i)).xy;
}

// A node, or two leaf words. pair: the number of two words, or the reference of a node.
uvec4 loadPair(uint pair)
{
    return texelFetch(texels4_nodes, int(pair & ~kFullNodes));
}
#else
uvec2 loadLeafGroup(uint i)
{
    return unpackUint2x32(g_leaf_groups.data[i]);
}

uvec4 loadPair(uint pair)
{
    return uvec4(loadHalf(2u * pair), loadHalf(2u * pair + 1u));
}
#endif

#endif
