// SPDX-License-Identifier: MIT
// Child bases of nodes, and the levels of listed nodes, from the lowest one up.
#ifndef ZVO_SHADERS_OCTREE_NODES_GLSL
#define ZVO_SHADERS_OCTREE_NODES_GLSL

#include "lib/dispatch.glsl"
#include "octree/octree.h"

// Sets the child base of a node.
void setBase(Node_Ptr nodes, uint node, uint mask_lo, uint base)
{
    nodes.data[node].base_lo = base;
    nodes.data[node].base_hi = base + bitCount(mask_lo);
}

// Workgroups for one thread a node.
DispatchArgs nodeArgs(uint node_count, uint max_groups_x)
{
    return foldedArgs((node_count + kNodesGroup - 1u) / kNodesGroup, max_groups_x);
}

// Sets a level's range of work items, which begins behind that of the level before, and the workgroups for it.
// node_count: of all nodes listed so far.
void setLevel(LevelRange_Ptr ranges, DispatchArgs_Ptr args, uint height, uint node_count, uint max_groups_x)
{
    uint first = 0u;
    if (height != 0u)
        first = ranges.data[height - 1u].first + ranges.data[height - 1u].count;
    ranges.data[height] = LevelRange(first, node_count - first);
    args.data[height] = nodeArgs(node_count - first, max_groups_x);
}

#endif
