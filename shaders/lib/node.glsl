// SPDX-License-Identifier: MIT
// Children of a node (shared/octree.h, shared/svdag.h).
#ifndef ZVO_SHADERS_LIB_NODE_GLSL
#define ZVO_SHADERS_LIB_NODE_GLSL

#include "lib/lists.glsl"

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
