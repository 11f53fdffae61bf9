#version 460
// SPDX-License-Identifier: MIT
// Writes the unique inner nodes of a level with their lists and, for attributes, what is before each child. Levels go
// from the leaves up, as what is below a node is the sum of what is below its children.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(UniqueListsParams, SVDAG_LISTS_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"
#include "svdag/candidate.glsl"

// Voxels below a node, and nodes, itself included.
BeforeChild belowOf(uint number)
{
    if (kAboveLeaves && kFilled)
    {
        Node leaf = Node_ConstPtr(uint64_t(params.pool)).data[number]; // the second word is the surface mask
        return BeforeChild(bitCount(leaf.mask_hi) + bitCount(leaf.base_hi), 1u);
    }
    if (kAboveLeaves)
    {
        uvec2 mask = nodeMask(Node_ConstPtr(uint64_t(params.pool)), number + params.leaf_reference);
        return BeforeChild(bitCount(mask.x) + bitCount(mask.y), 1u);
    }
    return params.below.data[number];
}

// Entries of two lists may share a word.
void setEntry(uint index, uint child)
{
    if (kPerWord == 2u)
        params.halfwords.data[index] = child;
    else if (kPerWord == 4u)
        atomicOr(params.halfwords.data[index / 2u], child << (16u * (index & 1u)));
    else
    {
        uint bits = kListWordBits / kPerWord;
        uvec2 word = unpackUint2x32(uint64_t(child) << (bits * (index % kPerWord)));
        atomicOr(params.halfwords.data[2u * (index / kPerWord)], word.x);
        atomicOr(params.halfwords.data[2u * (index / kPerWord) + 1u], word.y);
    }
}

void setBefore(uint entry, BeforeChild before)
{
    if (kAboveLeaves)
    {
        uint leaf_entry = entry - params.long_entry_count; // here, too
        atomicOr(params.voxels_before_leaf.data[leaf_entry / 2u], before.voxels << (16u * (leaf_entry & 1u)));
    }
    else
    {
        params.before.data[entry] = before;
    }
}

// What an entry says of a child among the DAG's nodes: its number, or that of its word.
uint named(uint child)
{
    if (kAboveLeaves && kFilled)
        return 2u * child;
    return leafWord(child + params.leaf_reference);
}

// The base of nodes that are full.
uint fullBase()
{
    return kChildList | params.first_index;
}

// Writes the full node and its list.
void writeFullNode()
{
    params.pool.data[params.full_node] = Node(~0u, fullBase(), ~0u, fullBase() + 32u);
    for (uint i = 0u; i < kFullEntries; ++i)
    {
        setEntry(params.first_index + i, params.full_node);
        if (kBefore)
            params.before.data[i] = BeforeChild(0u, kInteriorIndex);
    }
}

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    uint number = params.first_node + index;
    uint candidate = params.unique_nodes.data[number];
    Node node = params.nodes.data[candidate];
    if (kFilled && number == 0u)
        writeFullNode();
    uint first_entry = params.first_entries.data[candidate] + (kFilled ? kFullEntries : 0u);
    uint count = childCount(node);
    BeforeChild before = BeforeChild(0u, 0u);
    for (uint i = 0u; i < count; i += 4u)
    {
        uvec4 references = childrenAt(node, params.nodes, fourOf(count, i));
        uvec4 children = loadFour(params.classes, references - params.child_reference);
        children = loadFour(params.numbers, children);
        BeforeChild below[4];
        [[unroll]] for (uint k = 0u; k < 4u; ++k)
            below[k] = kBefore ? belowOf(children[k]) : before;
        [[unroll]] for (uint k = 0u; k < 4u; ++k)
            if (i + k < count)
            {
                setEntry(params.first_index + first_entry + i + k, named(children[k]));
                if (kBefore)
                    setBefore(first_entry + i + k, before);
                before.voxels += below[k].voxels;
                before.nodes += below[k].nodes;
            }
    }
    if (kBefore)
        params.below.data[number] = BeforeChild(before.voxels, before.nodes + 1u);
    uint base = kChildList | (params.leaf_reference & kLeafWords) | (params.first_index + first_entry);
    if (kFilled && isFullNode(node.base_lo))
        base = fullBase();
    params.pool.data[number] = Node(node.mask_lo, base, node.mask_hi, base + bitCount(node.mask_lo));
}
