#version 460
// SPDX-License-Identifier: MIT
// Numbers the children of a level's nodes, by one workgroup that walks over the nodes, and sizes the next level.
#extension GL_GOOGLE_include_directive : require
#include "light/light_tree.h"

GPU_ENTRY(LightScanParams, GPU_NO_CONSTANTS);
layout(local_size_x = kLightGroup) in;

#define SCAN_GROUP kLightGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

void main()
{
    LightLevel level = params.levels.data[params.level];
    uint carry = level.first + level.count;
    for (uint first = 0u; first < level.count; first += kLightGroup)
    {
        uint i = first + gl_LocalInvocationIndex;
        uint count = 0u;
        if (i < level.count)
            count = bitCount(params.nodes.data[level.first + i].mask_lo) +
                    bitCount(params.nodes.data[level.first + i].mask_hi);
        uint total;
        uint before = workgroupExclusiveAdd(count, total);
        if (i < level.count)
            params.nodes.data[level.first + i].first_child = carry + before;
        carry += total;
    }
    if (gl_LocalInvocationIndex != 0u)
        return;
    uint end = level.first + level.count;
    uint count = carry <= params.capacity ? carry - end : 0u;
    params.levels.data[params.level + 1u] = LightLevel(end, count);
    params.args.data[params.level + 1u] = foldedArgs(count, params.max_groups_x);
}
