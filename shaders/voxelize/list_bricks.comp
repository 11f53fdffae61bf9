#version 460
// SPDX-License-Identifier: MIT
// Lists the bricks of the table. The order of the list is arbitrary: bricks get their numbers from their position in
// the tree later.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(ListBricksParams, VOXELIZE_LIST_BRICKS_CONSTANTS);
layout(local_size_x = kListGroup) in;

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define BRICKS_BINDING 0
#include "lib/brick_loads.glsl"

DispatchArgs itemGroups(uint items)
{
    return foldedArgs((items + kItemsGroup - 1u) / kItemsGroup, params.max_groups_x);
}

void main()
{
    uint first_entry = workgroupIndex() * (kListGroup * kListItems) + gl_LocalInvocationIndex;
    uint occupied = 0u;
    for (uint i = 0u; i < kListItems; ++i)
    {
        uint entry = first_entry + i * kListGroup;
        bool is_brick = entry < params.brick_capacity && loadBrick(min(entry, params.brick_capacity - 1u)).key != 0u;
        occupied |= is_brick ? 1u << i : 0u;
    }
    uint count = bitCount(occupied);
    uint total = subgroupAdd(count);
    uint place = subgroupExclusiveAdd(count);
    uint first = 0u;
    if (subgroupElect() && total != 0u)
        first = atomicAdd(params.counters.data[0].brick_count, total);
    place += subgroupBroadcastFirst(first);
    for (; occupied != 0u; occupied &= occupied - 1u)
    {
        uint entry = first_entry + uint(findLSB(occupied)) * kListGroup;
        params.bricks.data[entry].mask_lo = place;
        if (place < params.range_capacity)
            params.ranges.data[place] = BrickRange(entry, 0u, 0u, 0u);
        ++place;
    }
    const uint block = kListGroup * kListItems;
    uint group_count = (params.brick_capacity + block - 1u) / block;
    if (workgroupIndex() >= group_count)
        return;
    uint here = arrivingThreads();
    uint arrived = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(arrived, here, group_count * kListGroup) && subgroupElect())
    {
        uint all_bricks = atomicOr(params.counters.data[0].brick_count, 0u);
        uint bricks = min(all_bricks, params.range_capacity);
        // Of a run that is thrown away nothing is covered.
        bool fits = bricks == all_bricks && atomicOr(params.counters.data[0].item_count, 0u) <= params.item_capacity &&
                    atomicOr(params.counters.data[0].large_count, 0u) <= params.large_capacity &&
                    atomicOr(params.counters.data[0].item_carry, 0u) == 0u &&
                    atomicOr(params.counters.data[0].setup_count, 0u) <= params.setup_capacity &&
                    atomicOr(params.counters.data[0].blocks_exceeded, 0u) == 0u &&
                    atomicOr(params.counters.data[0].overflow_count, 0u) == 0u;
        uint listed = fits ? bricks : 0u;
        uint items = fits ? atomicOr(params.counters.data[0].item_count, 0u) : 0u;
        params.counters.data[0].fits = fits ? 1u : 0u;
        params.counters.data[0].listed_count = listed;
        params.counters.data[0].covered_items = items;
        uint known_items = min(params.counters.data[0].known_items, items);
        params.counters.data[0].known = itemGroups(known_items);
        params.counters.data[0].cover = itemGroups(items - known_items);
        params.counters.data[0].collect = foldedArgs((listed + kBricksGroup - 1u) / kBricksGroup, params.max_groups_x);
        params.counters.data[0].fill = foldedArgs(
            (listed * params.fill_lanes + kBricksGroup - 1u) / kBricksGroup, params.max_groups_x);
        params.counters.data[0].vote = foldedArgs(listed, params.max_groups_x);
        params.counters.data[0].leaves = foldedArgs(
            max((listed * kBrickLanes + kBricksGroup - 1u) / kBricksGroup, 1u), params.max_groups_x);
        atomicExchange(params.counters.data[0].arrived, 0u);
    }
}
