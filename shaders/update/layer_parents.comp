#version 460
// SPDX-License-Identifier: MIT
// Puts the nodes above a filled layer's bricks into its table: who inserts a node inserts its parent, too.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(LayerParentsParams, UPDATE_LAYER_PARENTS_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/window.glsl"

void main()
{
    if (threadIndex() >= params.bins.data[0].listed_count)
        return;
    uvec2 key = keyOf(loadBrick(params.ranges.data[threadIndex()].entry));
    bool claimed = true;
    for (uint level = brickLevel(); claimed && level != 0u; --level)
    {
        uint cell = key.x & 63u;
        key = parentKey(key);
        uint entry = brickFindOrInsert(key, claimed);
        if (entry != kNoEntry)
            setCell(entry, cell);
        else
            atomicAdd(params.bins.data[0].overflow_count, 1u);
    }
}
