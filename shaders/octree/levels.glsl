// SPDX-License-Identifier: MIT
// The levels of listed nodes, from the leaves up.
#ifndef ZVO_SHADERS_OCTREE_LEVELS_GLSL
#define ZVO_SHADERS_OCTREE_LEVELS_GLSL

#include "lib/dispatch.glsl"
#include "octree/octree.h"

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
