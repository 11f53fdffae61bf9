#version 460
// SPDX-License-Identifier: MIT
// Puts the leaves of all layers into the table of touched nodes. Leaves of several layers with the same key share an
// entry: its mask is the union of theirs, and they are chained, in any order.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#define BRICKS_CONSTANT_ID 0
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kUpdateGroup) in;
layout(push_constant, scalar) uniform Push
{
    InsertParams params;
};

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

void main()
{
    uint record = threadIndex();
    if (record >= params.record_count)
        return;
    uint number = layerOf(record);
    Layer layer = params.layers.data[number];
    LayerCounters counters = layer.counters.data[0];
    uint i = record - layer.first_record;
    if (counters.failed != 0u)
    {
        if (i == 0u)
            atomicOr(params.status.data[0].failed, kFailedLayer);
        return;
    }
    if (i >= counters.leaf_count)
        return;
    uvec2 key = layer.keys.data[i];
    bool claimed;
    uint entry = brickFindOrInsert(params.bricks, params.brick_mask, key, claimed);
    if (entry == kNoEntry)
    {
        atomicAdd(params.counters.data[0].overflow_count, 1u);
        return;
    }
    Node leaf = layer.leaves.data[i];
    uint before_lo = atomicOr(params.bricks.data[entry].mask_lo, leaf.mask_lo);
    uint before_hi = atomicOr(params.bricks.data[entry].mask_hi, leaf.mask_hi);
    atomicAdd(params.status.data[0].dynamic_count,
              bitCount(leaf.mask_lo & ~before_lo) + bitCount(leaf.mask_hi & ~before_hi));
    params.links.data[record] = LayerLink(atomicExchange(params.heads.data[entry], record + 1u), number);
    if (claimed)
        params.items.data[atomicAdd(params.counters.data[0].node_count, 1u)] = WorkItem(entry, 0u);
}
