// SPDX-License-Identifier: MIT
// Nodes and their children (shared/octree.h), which lists may name (shared/svdag.h).
#ifndef ZVO_SHADERS_LIB_NODE_GLSL
#define ZVO_SHADERS_LIB_NODE_GLSL

#include "shared/svdag.h"

// The entry with an index. per_word: of all entries of the pool, 2, 3 or 4, best a constant.
uint listEntry(uint64_t_ConstPtr pool, uint index, uint per_word)
{
    if (per_word != 3u)
    {
        // Reads half words, because shifts of 64 bits are slow.
        uint half_word = uint_ConstPtr(uint64_t(pool)).data[per_word == 4u ? index >> 1 : index];
        return per_word == 4u ? bitfieldExtract(half_word, int(16u * (index & 1u)), 16) : half_word;
    }
    uint bits = kListWordBits / per_word;
    return uint(pool.data[index / per_word] >> (bits * (index % per_word))) & ((1u << bits) - 1u);
}

// Four entries, whose words are loaded together.
uvec4 listEntries(uint64_t_ConstPtr pool, uvec4 indices, uint per_word)
{
    return uvec4(listEntry(pool, indices.x, per_word), listEntry(pool, indices.y, per_word),
                 listEntry(pool, indices.z, per_word), listEntry(pool, indices.w, per_word));
}

bool hasChild(Node node, uint cell)
{
    return (((cell < 32u ? node.mask_lo : node.mask_hi) >> (cell & 31u)) & 1u) != 0u;
}

// The index of the child in a cell or, in a leaf, of the voxel's attribute; for a missing one, the index that it would
// have. For a list, kChildList and the index of the entry that names the child.
uint childIndex(Node node, uint cell)
{
    uint below = (1u << (cell & 31u)) - 1u;
    return cell < 32u ? node.base_lo + bitCount(node.mask_lo & below) : node.base_hi + bitCount(node.mask_hi & below);
}

// The child that childIndex() found, which must exist, of a node in a pool that may have lists.
uint listedChild(Node_ConstPtr pool, uint index, uint per_word)
{
    uint child = index;
    if ((index & kChildList) != 0u)
        child = listEntry(uint64_t_ConstPtr(uint64_t(pool)), index & ~kChildList, per_word);
    return child;
}

#endif
