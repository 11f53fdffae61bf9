#version 460
// SPDX-License-Identifier: MIT
// Puts the bricks in the order of their nodes, and counts the voxels of each block of kScanBlock bricks.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(PlaceBricksParams, VOXELIZE_PLACE_BRICKS_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint item = threadIndex();
    if (item >= params.brick_count)
        return;
    uint number = nodeOf(params.bricks.data[params.work.data[item].entry]) - params.first_node;
    uint brick = params.work_bricks.data[item];
    params.order.data[number] = brick;
    atomicAdd(params.partials.data[number / kScanBlock], params.ranges.data[brick].voxels);
}
