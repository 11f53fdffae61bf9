// SPDX-License-Identifier: MIT
// Inserts keys into a brick table, all at once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "insert_bricks.h"
#include "shared/bricks.h"

GPU_ENTRY(InsertBricksParams, TEST_INSERT_BRICKS_CONSTANTS);
layout(local_size_x = 64) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define BRICKS_BINDING 0
#include "lib/bricks.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.count)
        return;
    bool claimed = false;
    uvec2 key = params.keys.data[i];
    BrickEntry brick;
    uint entry = kFind ? brickFind(key, brick) : brickFindOrInsert(key, claimed);
    params.results.data[i] = uvec2(entry, claimed ? 1u : 0u);
}
