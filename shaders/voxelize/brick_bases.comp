#version 460
// SPDX-License-Identifier: MIT
// The first voxel of each brick: a prefix sum in the order of nodes.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BrickBasesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kAssignGroup) in;

#define SCAN_GROUP kAssignGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

uint voxelsOf(uint i)
{
    uint voxels = 0u;
    uint brick = kNoRange;
    if (i < params.brick_count)
        brick = params.order.data[i];
    if (brick != kNoRange)
        voxels = params.ranges.data[brick].voxels;
    return voxels;
}

void main()
{
    if (workgroupIndex() * kScanBlock >= params.brick_count)
        return;
    uint total;
    uint base = 0u;
    if (params.is_scanned != 0u)
    {
        base = params.partials.data[workgroupIndex()];
    }
    else
    {
        uint sum = 0u;
        for (uint i = gl_LocalInvocationIndex; i < workgroupIndex(); i += kAssignGroup)
            sum += params.partials.data[i];
        workgroupExclusiveAdd(sum, base);
    }
    uint first = threadIndex() * kAssignItems;
    uvec4 low = uvec4(voxelsOf(first), voxelsOf(first + 1u), voxelsOf(first + 2u), voxelsOf(first + 3u));
    uvec4 high = uvec4(voxelsOf(first + 4u), voxelsOf(first + 5u), voxelsOf(first + 6u), voxelsOf(first + 7u));
    base += workgroupExclusiveAdd(low.x + low.y + low.z + low.w + high.x + high.y + high.z + high.w, total);
    [[unroll]] for (uint i = 0u; i < kAssignItems; ++i)
    {
        uint brick = kNoRange;
        if (first + i < params.brick_count)
            brick = params.order.data[first + i];
        if (brick != kNoRange)
            params.ranges.data[brick].first_voxel = base;
        base += i < 4u ? low[i & 3u] : high[i & 3u];
    }
}
