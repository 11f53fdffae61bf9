#version 460
// SPDX-License-Identifier: MIT
// Makes a map of the simple sky, without the sun.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"

GPU_ENTRY(SkyTexelsParams, GPU_NO_CONSTANTS);
layout(local_size_x = kAliasGroup) in;

#include "lib/dispatch.glsl"
#include "lib/sky.glsl"
#include "light/outside.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.width * params.height)
        return;
    vec2 uv = (vec2(i % params.width, i / params.width) + 0.5) / vec2(params.width, params.height);
    params.texels.data[i] = skyRadiance(params.sky, directionInMap(uv.x, cos(kPi * uv.y)));
}
