// SPDX-License-Identifier: MIT
// Counts down from source[i]: how often the loop runs depends on what the buffer holds.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(CopyParams, GPU_NO_CONSTANTS);
layout(local_size_x = 64) in;

#include "lib/dispatch.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.count)
        return;
    uint steps = 0u;
    for (uint left = params.source.data[i] & 15u; left != 0u; --left)
        steps += params.factor;
    params.destination.data[i] = steps;
}
