// SPDX-License-Identifier: MIT
// Candidates of classes of equal nodes (svdag/svdag.h): their children, which of them are unique, and hashes of
// contents, which never decide equality.
// Needs the constant kEntriesPerWord, of the candidates' lists.
#ifndef ZVO_SHADERS_SVDAG_CANDIDATE_GLSL
#define ZVO_SHADERS_SVDAG_CANDIDATE_GLSL

#include "lib/node.glsl"
#include "lib/sampling.glsl"
#include "octree/octree.h"
#include "shared/svdag.h"

// Children that are candidates. Those of an octree's full node are none.
uint childCount(Node node)
{
    if (kEntriesPerWord == 0u && isFullNode(node.base_lo))
        return 0u;
    return bitCount(node.mask_lo) + bitCount(node.mask_hi);
}

// The reference to the child with so many before it in the node: its number, or kChildList and the index of an entry.
uint childIndexAfter(Node node, uint before)
{
    uint low = bitCount(node.mask_lo);
    return before < low ? node.base_lo + before : node.base_hi + (before - low);
}

// Four numbers from `first` on, the last of `count` in place of those that are no less. A thread takes four children or
// entries at a time, since it would wait as long for each of them.
uvec4 fourOf(uint count, uint first)
{
    return min(first + uvec4(0u, 1u, 2u, 3u), uvec4(count - 1u));
}

// The references to four children with so many before them in the node.
uvec4 childIndicesAfter(Node node, uvec4 before)
{
    uvec4 low = uvec4(bitCount(node.mask_lo));
    return mix(node.base_hi + (before - low), node.base_lo + before, lessThan(before, low));
}

// The references of the children of an inner node with so many before them in the node. No load waits for a condition:
// what is loaded for a node without a list is not used.
uvec4 childrenAt(Node node, Node_ConstPtr nodes, uvec4 before)
{
    uvec4 indices = childIndicesAfter(node, before);
    if (kEntriesPerWord == 0u)
        return indices;
    bvec4 listed = notEqual(indices & kChildList, uvec4(0u));
    uvec4 at = mix(uvec4(0u), indices & ~kListFlags, listed);
    uvec4 named = listEntries(uint64_t_ConstPtr(uint64_t(nodes)), at, kEntriesPerWord) | (indices & kLeafWords);
    return mix(indices, named, listed);
}

uvec4 loadFour(uint_ConstPtr from, uvec4 indices)
{
    return uvec4(from.data[indices.x], from.data[indices.y], from.data[indices.z], from.data[indices.w]);
}

// Which of the kScanItems candidates of a thread, in workgroups of kScanGroup, are unique: the first of their class.
struct UniqueCandidates
{
    uint nodes;                    // bit i: the candidate with i before it is unique
    uint entry_counts[kScanItems]; // of its list; 0 for others
};

// Loads of the same kind do not wait for each other, so many are under way.
UniqueCandidates uniqueCandidates(uint_ConstPtr classes, Node_ConstPtr nodes, uint first, uint node_count,
                                  uint inner_count)
{
    UniqueCandidates unique;
    unique.nodes = 0u;
    [[unroll]] for (uint i = 0u; i < kScanItems; ++i)
    {
        bool is_unique = classes.data[min(first + i, node_count - 1u)] == first + i;
        unique.nodes |= is_unique ? 1u << i : 0u;
        unique.entry_counts[i] = 0u;
    }
    if (first < inner_count)
        [[unroll]] for (uint i = 0u; i < kScanItems; ++i)
        {
            uint count = childCount(nodes.data[min(first + i, inner_count - 1u)]);
            bool counts = first + i < inner_count && ((unique.nodes >> i) & 1u) != 0u;
            unique.entry_counts[i] = counts ? count : 0u;
        }
    return unique;
}

uint hashMask(uint mask_lo, uint mask_hi)
{
    return hash(mask_lo ^ hash(mask_hi + 0x9E3779B9u));
}

#endif
