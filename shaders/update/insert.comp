#version 460
// SPDX-License-Identifier: MIT
// Puts the leaves of all layers into the table of touched nodes. Leaves of several layers with the same key share an
// entry: its mask is the union of theirs, and they are chained, in any order. The thread that inserts a node inserts its
// parent, too, and so on up: the table has all touched nodes then, and each level a list of its own. What layers that
// carve take stands in an array of its own.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(InsertParams, UPDATE_INSERT_CONSTANTS);
layout(local_size_x = kUpdateGroup) in;

#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "lib/brick_keys.glsl"
#include "lib/bricks.glsl"
#include "update/touched.glsl"

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

// Turns the key and the mask of a record of a layer that carves into those of the tree's grid, which is the first octant
// of the layer's. Returns whether it lies there.
bool toTree(uint kind, inout uvec2 key, inout uvec2 mask)
{
    const uint low_bits = (1u << kBrickKeyBits) - 1u;
    bool is_wide = (kind & kLayerWideKeys) != 0u;
    uvec2 code = is_wide ? key & ~kBrickKeyTag : uvec2(key.x & low_bits, key.x >> kBrickKeyBits);
    bool is_there = true;
    if ((kind & kLayerDeeper) != 0u)
    {
        uint marker = code.y != 0u ? kBrickKeyBits + uint(findMSB(code.y)) : uint(findMSB(code.x));
        if (marker == 0u) // above the tree's root
        {
            is_there = (mask.x & 1u) != 0u;
            mask = uvec2(~0u);
        }
        else
        {
            uint octant = marker - 6u; // 6 bits, which follow the marker
            uvec2 bits = octant < kBrickKeyBits ? uvec2(0x7fu << octant & low_bits, 0u) : uvec2(0u, 0u);
            bits.y = octant < kBrickKeyBits ? 0x7fu >> min(kBrickKeyBits - octant, 31u) : 0x7fu << (octant - kBrickKeyBits);
            uvec2 first = marker < kBrickKeyBits ? uvec2(1u << marker, 0u) : uvec2(0u, 1u << (marker - kBrickKeyBits));
            is_there = (code & bits) == first;
            code ^= first;
            code |= octant < kBrickKeyBits ? uvec2(1u << octant, 0u) : uvec2(0u, 1u << (octant - kBrickKeyBits));
        }
    }
    key = kWideKeys ? code | kBrickKeyTag : uvec2(code.x | (code.y << kBrickKeyBits), 0u);
    return is_there;
}

// Notes what a layer that carves takes.
void cutNode(uint entry, uvec2 mask)
{
    CarvedNode_Ptr carved = params.state.data[0].carved;
    atomicOr(carved.data[entry].cut_lo, mask.x);
    atomicOr(carved.data[entry].cut_hi, mask.y);
}

// Lists an entry that was claimed, and inserts the nodes above it.
void insertParents(uint entry, uvec2 key, uint height, bool claimed)
{
    for (; claimed && height < params.level_count; ++height)
    {
        if (!kCarves)
            listTouched(entry, height);
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

// Inserts the leaves beside a leaf that lose a neighbour of their voxels, so that these get attributes.
void insertExposed(uvec2 key, uvec2 cut)
{
    uint level = params.level_count - 1u;
    uvec3 leaf = brickCell(key, level);
    for (uint side = 0u; side < 6u; ++side)
    {
        uvec2 low = uvec2(side < 2u ? 0x00550055u : side < 4u ? 0x00003333u : 0x0f0f0f0fu);
        uvec2 high = uvec2(side < 2u ? 0xaa00aa00u : side < 4u ? 0xcccc0000u : 0xf0f0f0f0u);
        low.y = side < 4u ? low.y : 0u; // the lower half of a mask has the cells with z < 2
        high.x = side < 4u ? high.x : 0u;
        uvec2 facing = cut & ((side & 1u) != 0u ? high : low);
        uvec3 beside = leaf + uvec3(equal(uvec3(side >> 1), uvec3(0u, 1u, 2u))) * ((side & 1u) != 0u ? 1u : ~0u);
        if ((facing.x | facing.y) != 0u && all(lessThan(beside, uvec3(1u << (2u * level)))))
        {
            bool claimed;
            uvec2 beside_key = brickKey(beside, level);
            uint entry = brickFindOrInsert(beside_key, claimed);
            if (entry != kNoEntry)
                insertParents(entry, beside_key, 0u, claimed);
            else
                atomicAdd(params.counters.data[0].overflow_count, 1u);
        }
    }
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
    Node leaf = layer.leaves.data[i];
    bool carves = kCarves && (layer.kind & kLayerCarves) != 0u;
    if (carves)
    {
        uvec2 mask = uvec2(leaf.mask_lo, leaf.mask_hi);
        if (!toTree(layer.kind, key, mask))
            return;
        leaf.mask_lo = mask.x;
        leaf.mask_hi = mask.y;
    }
    bool claimed;
    uint entry = brickFindOrInsert(key, claimed);
    if (entry == kNoEntry)
    {
        atomicAdd(params.counters.data[0].overflow_count, 1u);
        return;
    }
    uint height = carves ? params.level_count - 1u - levelOfKey(key) : 0u;
    if (carves)
    {
        cutNode(entry, uvec2(leaf.mask_lo, leaf.mask_hi));
    }
    else
    {
        uint before_lo = atomicOr(params.bricks.data[entry].mask_lo, leaf.mask_lo);
        uint before_hi = atomicOr(params.bricks.data[entry].mask_hi, leaf.mask_hi);
        atomicAdd(params.state.data[0].status.dynamic_count,
                  bitCount(leaf.mask_lo & ~before_lo) + bitCount(leaf.mask_hi & ~before_hi));
        params.links.data[record] = LayerLink(atomicExchange(params.heads.data[entry], record + 1u), number);
    }
    insertParents(entry, key, height, claimed);
    if (kExposes && carves && height == 0u)
        insertExposed(key, uvec2(leaf.mask_lo, leaf.mask_hi));
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
    if (areLastThreads(before, here, group_count * kUpdateGroup) && subgroupElect() && !kCarves)
        params.counters.data[0].node_count = sizeLevels();
}
