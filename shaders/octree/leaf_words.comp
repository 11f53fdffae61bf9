#version 460
// SPDX-License-Identifier: MIT
// Copies an octree whose leaves are nodes; leaves become leaf words, whose first voxels stand in leaf groups. In a filled
// tree, the nodes have the surface alone, and full nodes have no children yet.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(LeafWordsParams, OCTREE_LEAF_WORDS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

// The voxels before a word; behind the last leaf, those before that leaf.
uint voxelsBefore(uint word)
{
    uint first_word = 2u * params.inner_count;
    uint leaf = min(max(word, first_word) - first_word, params.leaf_count - 1u);
    return params.from.data[params.inner_count + leaf].base_lo;
}

uvec2 leafGroup(uint word)
{
    uint first = voxelsBefore(word);
    uvec3 before = uvec3(voxelsBefore(word + 2u), voxelsBefore(word + 4u), voxelsBefore(word + 6u)) - first;
    return uvec2(first, before.x | (before.y << kGroupShift2) | (before.z << kGroupShift3));
}

Node fullNode()
{
    uint first = kFullNodes | params.first_full;
    return Node(~0u, first, ~0u, first + 32u);
}

// Surface masks and full nodes. number: of a node; there are at least as many threads as full nodes.
void writeSurface(uint number)
{
    uint leaf = number - params.inner_count;
    uint first_word = 2u * (params.first_full + kFullNodeCount);
    if (number < kFullNodeCount)
        params.to.data[params.first_full + number] = fullNode();
    if (number >= params.inner_count && leaf < params.leaf_count)
        params.surface.data[first_word + leaf] =
            uvec2(params.from.data[number].mask_lo, params.from.data[number].mask_hi);
    if (number + 1u == params.inner_count + params.leaf_count && (params.leaf_count & 1u) != 0u)
        params.surface.data[first_word + params.leaf_count] = uvec2(0u);
}

void main()
{
    uint number = threadIndex();
    if (kFilled)
        writeSurface(number);
    if (number >= params.inner_count + params.leaf_count)
        return;
    Node node = params.from.data[number];
    bool is_inner = number < params.inner_count;
    uint word = number + min(number, params.inner_count);
    if (is_inner)
    {
        uint reference = number < params.first_parent ? 0u : kLeafWords + params.inner_count;
        bool is_full = kFilled && (node.mask_lo | node.mask_hi) == 0u;
        params.to.data[number] = is_full ? fullNode()
                                         : Node(node.mask_lo, node.base_lo + reference, node.mask_hi,
                                                node.base_hi + reference);
    }
    else
    {
        uvec2 mask = uvec2(node.mask_lo, node.mask_hi);
        if (kFilled)
            mask = params.occupied.data[number - params.inner_count];
        uint64_t_Ptr(uint64_t(params.to)).data[word] = packUint2x32(mask);
    }
    if (number == 0u)
    {
        params.leaf_groups.data[0] = uvec2(params.inner_count, params.attribute_offset);
        uint surface = params.first_full + kFullNodeCount - params.inner_count;
        params.leaf_groups.data[1] = uvec2(kFilled ? surface : 0u, 0u);
    }
    if (word % kLeafGroup == 0u)
        params.leaf_groups.data[kFirstLeafGroup + word / kLeafGroup] = leafGroup(word);
    if (number + 1u == params.inner_count + params.leaf_count && (word & 1u) == 0u)
        uint64_t_Ptr(uint64_t(params.to)).data[word + 1u] = 0ul; // pools end in zeros
}
