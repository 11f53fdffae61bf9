// SPDX-License-Identifier: MIT
// Writes its specialization constants and its workgroup's size, once a thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"
#include "lib/dispatch.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kValue = 7;
layout(constant_id = 2) const bool kFlag = false;
layout(push_constant, scalar) uniform Params
{
    FillParams params;
};

void main()
{
    uint i = threadIndex();
    if (i < params.count)
    {
        params.values.data[i] = gl_WorkGroupSize.x * 1000 + kValue * 10 + (kFlag ? 1 : 0);
    }
}
