// SPDX-License-Identifier: MIT
// Makes items, in the order of triangles, so that neighbours are mostly of one brick.
// Needs the constants kWideKeys and kBlockLanes, and params.bricks, brick_mask, items, voxels, item_capacity and
// counters; and kVoxelsStride: ItemVoxels of an item.
#ifndef ZVO_SHADERS_VOXELIZE_BIN_GLSL
#define ZVO_SHADERS_VOXELIZE_BIN_GLSL

#include "voxelize/bricks.h"

#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/bricks.glsl"
#include "voxelize/window.glsl"

#ifdef BOUND
STORAGE(19, BrickItem, items);
STORAGE(20, ItemVoxels, voxels);
#define ITEM(I) storage_items.data[I]
#define ITEM_VOXELS(I) storage_voxels.data[I]
#else
#define ITEM(I) params.items.data[I]
#define ITEM_VOXELS(I) params.voxels.data[I]
#endif

// Workgroups of voxelize/bin_large.
uint largeGroups(uint block_count)
{
    return (block_count + kLargeGroup / kBlockLanes - 1u) / (kLargeGroup / kBlockLanes);
}

// The entry of the brick with this key, which it gets if it has none.
uint brickEntry(uvec2 key)
{
    bool claimed;
    uint entry = brickFindOrInsert(key, claimed);
    if (entry == kNoEntry)
        atomicAdd(params.counters.data[0].overflow_count, 1u);
    return entry;
}

// Makes room for items. Returns the first one's place.
uint addItems(uint count)
{
    uint first = atomicAdd(params.counters.data[0].item_count, count);
    if (first + count < first)
        atomicAdd(params.counters.data[0].item_carry, 1u);
    return first;
}

void writeItem(uint place, BrickItem item, ItemVoxels voxels)
{
    if (place < params.item_capacity)
    {
        ITEM(place) = item;
        ITEM_VOXELS(kVoxelsStride * place) = voxels;
    }
}

#endif
