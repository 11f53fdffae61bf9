// SPDX-License-Identifier: MIT
// Holds structs with every kind of member, in push constants and in a buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(LayoutParams, GPU_NO_CONSTANTS);
layout(local_size_x = 4, local_size_y = 2, local_size_z = 3) in;

GPU_BUFFER(Sample, 8);

void main()
{
    Sample_Ptr copy = Sample_Ptr(uint64_t(params.a.address));
    copy.data[gl_LocalInvocationIndex] = params.a;
}
