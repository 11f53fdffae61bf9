// SPDX-License-Identifier: MIT
// Breaks the rules on purpose: all workgroups write the same word without atomics.
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
    params.values.data[0] = threadIndex();
}
