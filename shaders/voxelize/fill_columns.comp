#version 460
// SPDX-License-Identifier: MIT
// Enters the listed bricks into their columns.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(FillColumnsParams, VOXELIZE_FILL_COLUMNS_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#define BRICKS_BINDING 0
#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/fill_columns.glsl"

void main()
{
    uint number = threadIndex();
    if (number >= params.counters.data[0].listed_count)
        return;
    uvec3 brick = brickCell(keyOf(loadBrick(params.ranges.data[number].entry)), brickLevel());
    for (uint line = 0u; line < (kRobust ? kFillAxes : 1u); ++line)
    {
        uint part = brick.y >> kPartLog2;
        uvec3 column = uvec3(brick.xz, line);
        bool entered = setInColumn(column, kPartBricks, part, brick.y & 63u) &&
                       setInColumn(column, kColumnParts, part >> kPartLog2, part & 63u);
        if (!entered)
            atomicAdd(params.counters.data[0].overflow_count, 1u);
        brick = brick.yzx;
    }
}
