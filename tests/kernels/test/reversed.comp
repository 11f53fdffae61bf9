// SPDX-License-Identifier: MIT
// Writes the number of threads after each thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"
#include "lib/dispatch.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Params
{
    FillParams params;
};

void main()
{
    uint i = threadIndex();
    if (i < params.count)
    {
        params.values.data[i] = params.count - 1 - i;
    }
}
