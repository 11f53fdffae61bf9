#version 460
// SPDX-License-Identifier: MIT
// Lists the band's bricks of the table, in any order; the host puts them in order.
#extension GL_GOOGLE_include_directive : require
#include "distance/distance.h"

GPU_ENTRY(ListBandParams, DISTANCE_LIST_CONSTANTS);
layout(local_size_x = kListGroup) in;

#include "distance/band_keys.glsl"
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint entry = threadIndex();
    if (entry > params.brick_mask)
        return;
    BrickEntry brick = params.bricks.data[entry];
    if (!isBandKey(keyOf(brick)))
        return;
    uint place = atomicAdd(params.counters.data[0].brick_count, 1u);
    atomicAdd(params.counters.data[0].leaf_count, bitCount(brick.mask_lo) + bitCount(brick.mask_hi));
    if (place < params.listed_capacity)
        params.listed.data[place] =
            BandBrick(brickOfBandKey(keyOf(brick)), entry, brick.mask_lo, brick.mask_hi, 0u);
}
