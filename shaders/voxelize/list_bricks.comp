#version 460
// SPDX-License-Identifier: MIT
// Lists the bricks of the table, and gives each room for its items. The order of the list is arbitrary: bricks get
// their numbers from their position in the tree later.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(ListBricksParams, GPU_NO_CONSTANTS);
layout(local_size_x = kListGroup) in;

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define BRICKS_BINDING 0
#include "lib/brick_loads.glsl"

uint unitsOf(uint item_count)
{
    return (item_count + params.unit_items - 1u) / params.unit_items;
}

// A brick whose items did not all find room has those that did: the run is thrown away.
void listBrick(uint entry, uvec3 place, uint item_count)
{
    params.bricks.data[entry].mask_hi = place.y;
    if (place.x >= params.range_capacity)
        return;
    uint units = unitsOf(item_count);
    if (units > kUnitsMax)
        atomicMax(params.counters.data[0].wide_count, 1u);
    uint end = min(place.y + item_count, params.item_capacity);
    params.ranges.data[place.x] = BrickRange(entry, place.y, item_count, 0u, 0u, 0u, units, 0u);
    for (uint i = 0u; i < min(units, kUnitsMax); ++i)
    {
        uint first = min(place.y + i * params.unit_items, end);
        if (place.z + i < params.range_capacity + params.item_capacity / params.unit_items)
            params.units.data[place.z + i] = BrickUnit(place.x, first, min(end - first, params.unit_items), units);
    }
    for (uint i = 0u; i < (units > 1u ? kBrickWords : 0u); ++i)
        params.masks.data[place.x * kBrickWords + i] = 0u;
}

void main()
{
    uint first_entry = workgroupIndex() * (kListGroup * kListItems) + gl_LocalInvocationIndex;
    uint occupied = 0u;
    uvec3 count = uvec3(0u); // bricks, items, units
    for (uint i = 0u; i < kListItems; ++i)
    {
        uint entry = first_entry + i * kListGroup;
        BrickEntry brick = loadBrick(min(entry, params.brick_capacity - 1u));
        bool is_brick = entry < params.brick_capacity && brick.key != 0u;
        occupied |= is_brick ? 1u << i : 0u;
        count += is_brick ? uvec3(1u, brick.mask_lo, unitsOf(brick.mask_lo)) : uvec3(0u);
    }
    uvec3 before = subgroupExclusiveAdd(count);
    uvec3 total = subgroupAdd(count);
    uvec3 first = uvec3(0u);
    if (subgroupElect() && total.x != 0u)
    {
        first.x = atomicAdd(params.counters.data[0].brick_count, total.x);
        first.y = atomicAdd(params.counters.data[0].item_count, total.y);
        first.z = atomicAdd(params.counters.data[0].unit_count, total.z);
        if (first.y + total.y < first.y)
            atomicAdd(params.counters.data[0].item_carry, 1u);
    }
    uvec3 place = subgroupBroadcastFirst(first) + before;
    for (; occupied != 0u; occupied &= occupied - 1u)
    {
        uint entry = first_entry + uint(findLSB(occupied)) * kListGroup;
        uint item_count = params.bricks.data[entry].mask_lo;
        listBrick(entry, place, item_count);
        place += uvec3(1u, item_count, unitsOf(item_count));
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
                    atomicOr(params.counters.data[0].wide_count, 0u) == 0u &&
                    atomicOr(params.counters.data[0].overflow_count, 0u) == 0u;
        uint units = fits ? atomicOr(params.counters.data[0].unit_count, 0u) : 0u;
        params.counters.data[0].listed_count = fits ? bricks : 0u;
        params.counters.data[0].covered_units = units;
        params.counters.data[0].cover = foldedArgs(units, params.max_groups_x);
        params.counters.data[0].collect = foldedArgs((bricks + kBricksGroup - 1u) / kBricksGroup, params.max_groups_x);
        atomicExchange(params.counters.data[0].arrived, 0u);
    }
}
