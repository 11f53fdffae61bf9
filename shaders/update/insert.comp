#version 460
// SPDX-License-Identifier: MIT
// Puts the leaves of all layers into the table of touched nodes. Leaves of several layers with the same key share an
// entry: its mask is the union of theirs, and they are chained, in any order. The thread that inserts a node inserts its
// parent, too, and so on up: the table has all touched nodes then, and each level a list of its own.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(InsertParams, UPDATE_INSERT_CONSTANTS);
layout(local_size_x = kUpdateGroup) in;

#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "octree/nodes.glsl"
#include "lib/brick_keys.glsl"
#include "lib/bricks.glsl"

// The last layer whose records begin at this one or before.
uint layerOf(uint record)
{
    uint low = 0u;
    uint high = params.layer_count;
    for (; high - low > 1u;)
    {
        uint middle = (low + high) / 2u;
        bool before = params.layers.data[middle].first_record <= record;
        low = before ? middle : low;
        high = before ? high : middle;
    }
    return low;
}

void insertLeaf(uint record)
{
    uint number = layerOf(record);
    Layer layer = params.layers.data[number];
    LayerCounters counters = layer.counters.data[0];
    uint i = record - layer.first_record;
    if (counters.failed != 0u)
    {
        if (i == 0u)
            atomicOr(params.state.data[0].status.failed, kFailedLayer);
        return;
    }
    if (i >= counters.leaf_count)
        return;
    uvec2 key = layer.keys.data[i];
    bool claimed;
    uint entry = brickFindOrInsert(key, claimed);
    if (entry == kNoEntry)
    {
        atomicAdd(params.counters.data[0].overflow_count, 1u);
        return;
    }
    Node leaf = layer.leaves.data[i];
    uint before_lo = atomicOr(params.bricks.data[entry].mask_lo, leaf.mask_lo);
    uint before_hi = atomicOr(params.bricks.data[entry].mask_hi, leaf.mask_hi);
    atomicAdd(params.state.data[0].status.dynamic_count,
              bitCount(leaf.mask_lo & ~before_lo) + bitCount(leaf.mask_hi & ~before_hi));
    params.links.data[record] = LayerLink(atomicExchange(params.heads.data[entry], record + 1u), number);
    for (uint height = 0u; claimed && height < params.level_count; ++height)
    {
        uint place = params.ranges.data[height].first + atomicAdd(params.ranges.data[height].count, 1u);
        params.items.data[place] = WorkItem(entry, 0u);
        claimed = false;
        if (height + 1u < params.level_count)
        {
            uvec2 child = key;
            key = parentKey(child);
            entry = brickFindOrInsert(key, claimed);
            if (entry != kNoEntry)
                setCell(entry, child.x & 63u);
            else
                atomicAdd(params.counters.data[0].overflow_count, 1u);
        }
    }
}

// The last threads count the touched nodes and size the passes over each level.
void sizeLevels()
{
    uint node_count = 0u;
    for (uint height = 0u; height < params.level_count; ++height)
    {
        uint count = atomicAdd(params.ranges.data[height].count, 0u);
        params.args.data[height] = nodeArgs(count, params.max_groups_x);
        node_count += count;
    }
    params.counters.data[0].node_count = node_count;
}

void main()
{
    uint group_count = (params.record_count + kUpdateGroup - 1u) / kUpdateGroup;
    if (workgroupIndex() >= group_count)
        return;
    uint record = threadIndex();
    if (record < params.record_count)
        insertLeaf(record);
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived[0], here) : 0u;
    if (areLastThreads(before, here, group_count * kUpdateGroup) && subgroupElect())
        sizeLevels();
}
