// SPDX-License-Identifier: MIT
// What stands in a cell of an octree with leaf words.
#ifndef ZVO_SHADERS_ALGEBRA_OPERAND_GLSL
#define ZVO_SHADERS_ALGEBRA_OPERAND_GLSL

#include "algebra/algebra.h"
#include "lib/morton.glsl"
#include "lib/node.glsl"

const uint kNothing = ~0u; // in place of a reference

struct Found
{
    uint reference; // or kNothing
    uint around;    // number of the lowest node above it that is not one of the 64 full nodes
    uint cell;      // of it, in which the cell is
};

// The node in a cell of the level that is `levels` below the root.
Found findNode(Operand tree, uvec3 cell, uint levels)
{
    Found at = Found(0u, 0u, 0u);
    for (uint level = levels; level > 0u && at.reference != kNothing; --level)
    {
        uint child = cellInBlock(cell >> (2u * level - 2u));
        Node node = loadInner(tree.nodes, at.reference);
        if (!isFullNode(at.reference))
        {
            at.around = at.reference;
            at.cell = child;
        }
        at.reference = hasChild(node, child) ? childIndex(node, child) : kNothing;
    }
    return at;
}

// Whether all that is below an inner node is inside.
bool isFullBelow(Operand tree, uint reference)
{
    bool is_full = reference != kNothing;
    if (is_full && !isFullNode(reference))
        is_full = isFullNode(tree.nodes.data[reference].base_lo);
    return is_full;
}

// The occupied voxels of a leaf that was found.
uvec2 leafMask(Operand tree, Found leaf)
{
    uvec2 mask = uvec2(0u);
    if (leaf.reference != kNothing)
        mask = nodeMask(tree.nodes, leaf.reference);
    return mask;
}

// Those with attributes.
uvec2 surfaceMask(Operand tree, Found leaf)
{
    uvec2 mask = uvec2(0u);
    if (leaf.reference != kNothing && isLeafWord(leaf.reference))
        mask = nodeMask(tree.nodes, leaf.reference + 2u * tree.leaf_groups.data[1].x);
    return mask;
}

#endif
