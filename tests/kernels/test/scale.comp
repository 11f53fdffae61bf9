// SPDX-License-Identifier: MIT
// destination = source * factor.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(CopyParams, GPU_NO_CONSTANTS);
layout(local_size_x = 32) in;

#include "lib/dispatch.glsl"

void main()
{
    uint i = threadIndex();
    if (i < params.count)
    {
        params.destination.data[i] = params.source.data[i] * params.factor;
    }
}
