#version 460
// SPDX-License-Identifier: MIT
// Copies the leaves with centres in the band, a thread a cell.
#extension GL_GOOGLE_include_directive : require
#include "distance/distance.h"

GPU_ENTRY(KeepLeavesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kLeavesGroup) in;

#include "lib/dispatch.glsl"

void main()
{
    uint number = threadIndex() / kCentersInBand;
    uint cell = threadIndex() % kCentersInBand;
    if (number >= params.leaf_count)
        return;
    uint from = params.kept.data[number];
    params.squared.data[threadIndex()] = params.all_squared.data[from * kCentersInBand + cell];
    if (cell == 0u)
        params.leaves.data[number] = params.all_leaves.data[from];
}
