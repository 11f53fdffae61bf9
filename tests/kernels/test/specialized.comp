// SPDX-License-Identifier: MIT
// Writes its specialization constants and its workgroup's size, once a thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(FillParams, TEST_SPECIALIZED_CONSTANTS);
layout(local_size_x_id = 0) in;

#include "lib/dispatch.glsl"

void main()
{
    uint i = threadIndex();
    if (i < params.count)
    {
        params.values.data[i] = gl_WorkGroupSize.x * 1000 + kValue * 10 + (kFlag ? 1 : 0);
    }
}
