// SPDX-License-Identifier: MIT
// destination = source * factor.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"
#include "lib/dispatch.glsl"

layout(local_size_x = 32) in;
layout(push_constant, scalar) uniform Params
{
    CopyParams params;
};

void main()
{
    uint i = threadIndex();
    if (i < params.count)
    {
        params.destination.data[i] = params.source.data[i] * params.factor;
    }
}
