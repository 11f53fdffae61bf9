// SPDX-License-Identifier: MIT
// Writes the number of threads after each thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(FillParams, GPU_NO_CONSTANTS);
layout(local_size_x = 64) in;

#include "lib/dispatch.glsl"

void main()
{
    uint i = threadIndex();
    if (i < params.count)
    {
        params.values.data[i] = params.count - 1 - i;
    }
}
