#version 460
// SPDX-License-Identifier: MIT
// Copies an octree whose leaves are nodes; leaves become leaf words, whose first voxels stand in leaf groups.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(LeafWordsParams, GPU_NO_CONSTANTS);
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

void main()
{
    uint number = threadIndex();
    if (number >= params.inner_count + params.leaf_count)
        return;
    Node node = params.from.data[number];
    bool is_inner = number < params.inner_count;
    uint word = number + min(number, params.inner_count);
    if (is_inner)
    {
        uint reference = number < params.first_parent ? 0u : kLeafWords + params.inner_count;
        params.to.data[number] = Node(node.mask_lo, node.base_lo + reference, node.mask_hi, node.base_hi + reference);
    }
    else
    {
        uint64_t_Ptr(uint64_t(params.to)).data[word] = packUint2x32(uvec2(node.mask_lo, node.mask_hi));
    }
    if (number == 0u)
        params.leaf_groups.data[0] = uvec2(params.inner_count, params.attribute_offset);
    if (word % kLeafGroup == 0u)
        params.leaf_groups.data[1u + word / kLeafGroup] = leafGroup(word);
    if (number + 1u == params.inner_count + params.leaf_count && (word & 1u) == 0u)
        uint64_t_Ptr(uint64_t(params.to)).data[word + 1u] = 0ul; // pools end in zeros
}
