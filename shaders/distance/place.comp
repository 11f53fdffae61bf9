#version 460
// SPDX-License-Identifier: MIT
// Numbers the band's bricks in the table, and lists their leaves, a thread a brick.
#extension GL_GOOGLE_include_directive : require
#include "distance/distance.h"

GPU_ENTRY(PlaceBandParams, GPU_NO_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#include "lib/dispatch.glsl"
#include "lib/morton.glsl"

void main()
{
    uint number = threadIndex();
    if (number >= params.listed_count)
        return;
    BandBrick brick = params.listed.data[number];
    params.bricks.data[brick.entry].mask_lo = number;
    uint place = brick.first_leaf;
    for (uint leaf = 0u; leaf < kBrickLeaves; ++leaf)
    {
        bool exists = (((leaf < 32u ? brick.mask_lo : brick.mask_hi) >> (leaf & 31u)) & 1u) != 0u;
        if (exists)
            params.leaves.data[place] = BandLeaf(4u * brick.brick + cellNumbered(leaf), 0u, 0u, 0u);
        place += exists ? 1u : 0u;
    }
}
