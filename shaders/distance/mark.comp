#version 460
// SPDX-License-Identifier: MIT
// Finds the leaves that the band may reach, a thread an item: those around its piece of a triangle.
#extension GL_GOOGLE_include_directive : require
#include "distance/distance.h"

GPU_ENTRY(MarkBandParams, DISTANCE_MARK_CONSTANTS);
layout(local_size_x = kItemsGroup) in;

const uint kCoverage = kCoverageConservative;
const bool kEmits = false;

#define BRICKS_BINDING 0
#include "distance/piece.glsl"
#include "distance/band_keys.glsl"
#include "lib/cell_masks.glsl"
#include "lib/dispatch.glsl"

void markBrick(ivec3 brick, Cells cells)
{
    ivec3 first_leaf = brick * 4;
    uvec2 leaves = cellsBetween(max((cells.low >> 2) - first_leaf, ivec3(0)), (cells.high >> 2) - first_leaf);
    bool claimed;
    BrickEntry there;
    uint entry = brickFindOrInsert(bandKey(uvec3(brick)), claimed, there);
    if (entry == kNoEntry)
    {
        atomicAdd(params.band_counters.data[0].overflow_count, 1u);
        return;
    }
    if ((leaves.x & ~there.mask_lo) != 0u)
        atomicOr(BRICK_WORD(entry, kMaskWord), leaves.x);
    if ((leaves.y & ~there.mask_hi) != 0u)
        atomicOr(BRICK_WORD(entry, kMaskWord + 1u), leaves.y);
}

void main()
{
    uint i = threadIndex();
    if (i >= params.counters.data[0].covered_items)
        return;
    Cells cells = cellsInReach(pieceOf(i));
    if (isEmpty(cells))
        return;
    ivec3 first = cells.low >> int(kBrickLog2);
    ivec3 last = cells.high >> int(kBrickLog2);
    ivec3 size = last - first + 1;
    ivec3 brick = first;
    for (int left = size.x * size.y * size.z; left > 0; --left)
    {
        markBrick(brick, cells);
        bool row_ends = brick.x == last.x;
        bool layer_ends = row_ends && brick.y == last.y;
        brick = ivec3(row_ends ? first.x : brick.x + 1, layer_ends ? first.y : brick.y + (row_ends ? 1 : 0),
                      brick.z + (layer_ends ? 1 : 0));
    }
}
