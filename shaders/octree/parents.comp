#version 460
// SPDX-License-Identifier: MIT
// Every node of a level sets its bit in its parent, which the first of its children puts into the table and the list.
// In the end, the level of the parents has its range and its workgroups.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(ParentsParams, OCTREE_PARENTS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "octree/nodes.glsl"

#define BRICKS_BINDING 0
#include "lib/brick_keys.glsl"
#include "lib/brick_loads.glsl"
#include "lib/bricks.glsl"

void addToParent(uint item)
{
    uvec2 key = keyOf(loadBrick(params.items.data[item].entry));
    bool claimed;
    uint parent = brickFindOrInsert(parentKey(key), claimed);
    if (parent == kNoEntry)
    {
        atomicAdd(params.counters.data[0].overflow_count, 1u);
        return;
    }
    setCell(parent, key.x & 63u);
    params.items.data[item].parent_entry = parent;
    if (claimed)
        params.items.data[atomicAdd(params.counters.data[0].node_count, 1u)] = WorkItem(parent, 0u);
}

void main()
{
    LevelRange range = params.ranges.data[params.height];
    uint group_count = (range.count + kNodesGroup - 1u) / kNodesGroup;
    if (workgroupIndex() >= group_count)
        return;
    uint item = threadIndex();
    if (item < range.count)
        addToParent(range.first + item);
    uint next = params.height + 1u;
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived[next], here) : 0u;
    if (areLastThreads(before, here, group_count * kNodesGroup) && subgroupElect())
        setLevel(params.ranges, params.args, next, atomicAdd(params.counters.data[0].node_count, 0u),
                 params.max_groups_x);
}
