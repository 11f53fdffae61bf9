// SPDX-License-Identifier: MIT
// Breaks the rules on purpose: all workgroups write the same word without atomics.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(FillParams, GPU_NO_CONSTANTS);
layout(local_size_x = 64) in;

#include "lib/dispatch.glsl"

void main()
{
    params.values.data[0] = threadIndex();
}
