// SPDX-License-Identifier: MIT
// destination = source * factor; the bound form tells that it ran by adding kBoundMark.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(CopyParams, GPU_NO_CONSTANTS);
layout(local_size_x = 32) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#ifdef BOUND
TEXELS_1(0, source);

uint load(uint i)
{
    return texelFetch(texels1_source, int(i)).x + kBoundMark;
}
#else
uint load(uint i)
{
    return params.source.data[i];
}
#endif

void main()
{
    uint i = threadIndex();
    if (i < params.count)
        params.destination.data[i] = load(i) * params.factor;
}
