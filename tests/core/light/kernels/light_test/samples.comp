#version 460
// SPDX-License-Identifier: MIT
// Writes random numbers of samples.
#extension GL_GOOGLE_include_directive : require
#include "choose.h"

GPU_ENTRY(SamplesParams, GPU_NO_CONSTANTS);
layout(local_size_x = 64) in;

#include "lib/dispatch.glsl"
#include "lib/sampling.glsl"

void main()
{
    uint i = threadIndex();
    if (i < params.count)
        params.samples.data[i] = sampleBits(i, params.seed, params.pair);
}
