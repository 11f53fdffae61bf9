// SPDX-License-Identifier: MIT
// Puts items into bricks. Count first, then write: the table's entry of a brick counts its items in mask_lo, and has
// the place of the next one in mask_hi.
// Needs GPU_ENTRY with BinParams.
#ifndef ZVO_SHADERS_VOXELIZE_BIN_GLSL
#define ZVO_SHADERS_VOXELIZE_BIN_GLSL

#include "voxelize/bricks.h"

#include "lib/brick_keys.glsl"
#include "lib/bricks.glsl"
#include "voxelize/window.glsl"

const uint kCursorWord = kMaskWord + 1u;
const uint kNoPlace = ~0u;

// Level of the bricks among the nodes' levels.
uint brickLevel()
{
    return uint(gridDepth() - 1) / 2u - 1u;
}

// Workgroups of voxelize/bin_large.
uint largeGroups(uint block_count)
{
    return (block_count + kLargeGroup / kBlockLanes - 1u) / (kLargeGroup / kBlockLanes);
}

// Counts `count` items of the brick with this key. Or makes room for them, and returns the first one's place; the place
// of none if the brick is not in the table.
uint takeItems(uvec2 key, uint count)
{
    uint first = kNoPlace;
    if (kWrites)
    {
        BrickEntry found;
        uint entry = brickFind(key, found);
        if (entry != kNoEntry)
            first = atomicAdd(BRICK_WORD(entry, kCursorWord), count);
    }
    else
    {
        bool claimed;
        uint entry = brickFindOrInsert(key, claimed);
        if (entry != kNoEntry)
            atomicAdd(BRICK_WORD(entry, kMaskWord), count);
        else
            atomicAdd(params.counters.data[0].overflow_count, 1u);
    }
    return first;
}

void writeItem(uint place, uint draw, uint tile, uint triangle)
{
    if (place < params.item_capacity)
        params.items.data[place] = BrickItem(draw | (tile << kItemTileShift), triangle);
}

#endif
