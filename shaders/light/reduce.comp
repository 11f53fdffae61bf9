#version 460
// SPDX-License-Identifier: MIT
// Sums up the children of each node of a level: a thread for each child. Levels go from the leaves to the root. Sums
// are in the order of the children, whatever the device.
#extension GL_GOOGLE_include_directive : require
#include "light/light_tree.h"

GPU_ENTRY(LightReduceParams, GPU_NO_CONSTANTS);
layout(local_size_x = kLightGroup) in;

#include "lib/dispatch.glsl"
#include "light/bounds.glsl"

shared uvec3 s_low[kLightGroup];
shared uvec3 s_high[kLightGroup];
shared vec3 s_up[kLightGroup];
shared vec3 s_down[kLightGroup];

void main()
{
    LightLevel level = params.levels.data[params.level];
    uint item = workgroupIndex();
    if (item >= level.count)
        return;
    uint number = level.first + item;
    uint first = params.nodes.data[number].first_child;
    uint count = bitCount(params.nodes.data[number].mask_lo) + bitCount(params.nodes.data[number].mask_hi);
    uint i = gl_LocalInvocationIndex;
    bool has_child = i < count;
    s_low[i] = uvec3(~0u);
    s_high[i] = uvec3(0u);
    s_up[i] = vec3(0.0);
    s_down[i] = vec3(0.0);
    if (has_child)
    {
        s_low[i] = unpackLightCell(params.nodes.data[first + i].low);
        s_high[i] = unpackLightCell(params.nodes.data[first + i].high);
        s_up[i] = params.items.data[first + i].up;
        s_down[i] = params.items.data[first + i].down;
    }
    for (uint distance = kLightGroup / 2u; distance != 0u; distance /= 2u)
    {
        barrier();
        if (i < distance)
        {
            s_low[i] = min(s_low[i], s_low[i + distance]);
            s_high[i] = max(s_high[i], s_high[i + distance]);
            s_up[i] += s_up[i + distance];
            s_down[i] += s_down[i + distance];
        }
    }
    if (i != 0u)
        return;
    float power = dot(s_up[0] + s_down[0], vec3(1.0));
    params.items.data[number].up = s_up[0];
    params.items.data[number].down = s_down[0];
    params.nodes.data[number].low = packLightCell(s_low[0]);
    params.nodes.data[number].high = packLightCell(s_high[0]);
    params.nodes.data[number].power = power;
    params.nodes.data[number].parts = packLightParts(s_up[0], s_down[0], power);
    params.nodes.data[number].unused = 0u;
}
