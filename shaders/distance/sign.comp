#version 460
// SPDX-License-Identifier: MIT
// Finds the centres that are inside, and whether some are in the band, a thread a leaf. What is inside is as
// voxelize/fill has left it, or, where no triangle touches the brick, as the next brick above tells.
#extension GL_GOOGLE_include_directive : require
#include "distance/distance.h"

GPU_ENTRY(SignBandParams, DISTANCE_SIGN_CONSTANTS);
layout(local_size_x = kLeavesGroup) in;

#define BRICKS_BINDING 0
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "voxelize/fill_columns.glsl"

// Whether the cells from a brick on down to the next one below it are inside.
bool isInsideBelow(uvec3 brick)
{
    uvec3 column = uvec3(brick.xz, 0u);
    int above = brickFrom(column, int(brick.y));
    return above != kNoBrick && !isInColumn(column, kPartOpen, above);
}

void main()
{
    uint number = threadIndex();
    if (number >= params.leaf_count)
        return;
    uvec3 leaf = params.leaves.data[number].leaf + uint(kBandMargin / 4);
    uvec3 place = leaf >> 2;
    uvec2 inside = uvec2(0u);
    if (params.is_filled != 0u)
    {
        BrickEntry brick;
        bool touched = brickFind(brickKey(place, brickLevel()), brick) != kNoEntry;
        uint word = brick.mask_lo * (2u * kFillPlanes * kLeafMaskWords) + 2u * cellInBlock(leaf);
        if (touched)
            inside = uvec2(params.crossings.data[word], params.crossings.data[word + 1u]);
        else if (isInsideBelow(place))
            inside = uvec2(~0u);
    }
    uint least = kNoDistance;
    for (uint i = 0u; i < kCentersInBand; ++i)
        least = min(least, params.squared.data[number * kCentersInBand + i]);
    params.leaves.data[number].inside_lo = inside.x;
    params.leaves.data[number].inside_hi = inside.y;
    params.leaves.data[number].in_band = least != kNoDistance ? 1u : 0u;
}
