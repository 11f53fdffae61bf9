// SPDX-License-Identifier: MIT
// The leaves of bricks, and their mixed voxels.
// Needs params.nodes, mixed and first_leaf, and LEAVES_BINDING: the first of two bindings of the bound form.
#ifndef ZVO_SHADERS_VOXELIZE_MIXED_LEAF_GLSL
#define ZVO_SHADERS_VOXELIZE_MIXED_LEAF_GLSL

#include "lib/bound.glsl"
#include "lib/node.glsl"
#include "shared/bricks.h"

#ifdef BOUND
TEXELS_4(LEAVES_BINDING, nodes);
TEXELS_4(LEAVES_BINDING + 1, mixed);

Node loadLeaf(uint i)
{
    uvec4 words = texelFetch(texels4_nodes, int(i));
    return Node(words.x, words.y, words.z, words.w);
}

MixedVoxels loadMixedLeaf(uint i)
{
    uvec4 words = texelFetch(texels4_mixed, int(i - params.first_leaf));
    return MixedVoxels(words.x, words.y, words.z, words.w);
}
#else
Node loadLeaf(uint i)
{
    return params.nodes.data[i];
}

MixedVoxels loadMixedLeaf(uint i)
{
    return params.mixed.data[i - params.first_leaf];
}
#endif

// The node of a leaf of a brick. A grid of up to 4^3 is a leaf without nodes above it.
uint leafIndex(Node brick, uint leaf)
{
    return params.first_leaf == 0u ? 0u : childIndex(brick, leaf);
}

bool isMixed(MixedVoxels mixed, uint cell)
{
    return hasCell(uvec2(mixed.mask_lo, mixed.mask_hi), cell);
}

// The index of the sums of a mixed voxel.
uint sumsIndex(MixedVoxels mixed, uint cell)
{
    uint below = (1u << (cell & 31u)) - 1u;
    return mixed.first + (cell < 32u ? bitCount(mixed.mask_lo & below)
                                     : bitCount(mixed.mask_lo) + bitCount(mixed.mask_hi & below));
}

#endif
