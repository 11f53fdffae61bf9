#version 460
// SPDX-License-Identifier: MIT
// Finds what is left of each touched node where layers carve, and lists the nodes of which something is. A thread takes
// an entry of the table and looks up its node in the base tree; who finds that something is left of it tells its parent,
// and so on up. The root is always listed.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(CarveParams, UPDATE_CARVE_CONSTANTS);
layout(local_size_x = kUpdateGroup) in;

#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/arrivals.glsl"
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "lib/node.glsl"
#include "update/touched.glsl"

const uint kCarveArrivals = 1u; // in BrickCounters::arrived

uvec2 cutOf(uint entry)
{
    CarvedNode_Ptr carved = params.state.data[0].carved;
    return uvec2(carved.data[entry].cut_lo, carved.data[entry].cut_hi);
}

void setLeft(uint entry, uvec2 mask)
{
    CarvedNode_Ptr carved = params.state.data[0].carved;
    atomicOr(carved.data[entry].left_lo, mask.x);
    atomicOr(carved.data[entry].left_hi, mask.y);
}

uvec2 ancestorKey(uvec2 key, uint levels)
{
    for (uint i = 0u; i < levels; ++i)
        key = parentKey(key);
    return key;
}

// The base tree's node at the position of a touched node, or kNoNode if there is none or it is cut with one above it.
uint uncutNode(uvec2 key, uint level)
{
    uint node = params.base_root;
    for (uint l = 0u; l < level && node != kNoNode; ++l)
    {
        BrickEntry above;
        uint entry = brickFind(ancestorKey(key, level - l), above);
        uint cell = ancestorKey(key, level - l - 1u).x & 63u;
        bool exists = hasCell(nodeMask(params.nodes, node), cell) && !hasCell(cutOf(entry), cell);
        uint child = kNoNode;
        if (exists)
            child = listedChild(params.nodes, childIndex(loadInner(params.nodes, node), cell), kEntriesPerWord);
        node = child;
    }
    return node;
}

void carveNode(uint entry, BrickEntry brick)
{
    uvec2 key = keyOf(brick);
    uint level = levelOfKey(key);
    uint node = uncutNode(key, level);
    uvec2 left = uvec2(0u);
    if (node != kNoNode)
        left = nodeMask(params.nodes, node) & ~cutOf(entry);
    uvec2 touched = uvec2(brick.mask_lo, brick.mask_hi);
    left = level + 1u == params.level_count ? left | touched : left & ~touched;
    setLeft(entry, left);
    bool is_left = (left.x | left.y) != 0u || level == 0u;
    for (uint height = params.level_count - 1u - level; is_left && height < params.level_count; ++height)
    {
        is_left = atomicExchange(params.state.data[0].carved.data[entry].listed, 1u) == 0u;
        if (is_left)
            listTouched(entry, height);
        if (is_left && height + 1u < params.level_count)
        {
            uint cell = key.x & 63u;
            key = parentKey(key);
            BrickEntry above;
            entry = brickFind(key, above);
            setLeft(entry, cell < 32u ? uvec2(1u << cell, 0u) : uvec2(0u, 1u << (cell & 31u)));
        }
    }
}

void main()
{
    uint capacity = params.brick_mask + 1u;
    uint group_count = (capacity + kUpdateGroup - 1u) / kUpdateGroup;
    if (workgroupIndex() >= group_count)
        return;
    BrickEntry brick = loadBrick(min(threadIndex(), params.brick_mask));
    bool exists = threadIndex() < capacity && brick.key != 0u;
    if (exists && params.counters.data[0].overflow_count == 0u) // else the update fails
        carveNode(threadIndex(), brick);
    uint touched = subgroupAdd(exists ? 1u : 0u);
    if (subgroupElect())
        atomicAdd(params.counters.data[0].node_count, touched);
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived[kCarveArrivals], here) : 0u;
    if (areLastThreads(before, here, group_count * kUpdateGroup) && subgroupElect())
        sizeLevels();
}
