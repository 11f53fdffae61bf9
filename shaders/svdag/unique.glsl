// SPDX-License-Identifier: MIT
// Which of the kScanItems candidates of a thread, in workgroups of kScanGroup, are unique: the first of their class.
// The includer includes svdag/candidate.glsl before.
#ifndef ZVO_SHADERS_SVDAG_UNIQUE_GLSL
#define ZVO_SHADERS_SVDAG_UNIQUE_GLSL

#include "octree/octree.h"
#include "svdag/candidate.glsl"

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

#endif
