#version 460
// SPDX-License-Identifier: MIT
// Adds a sample of each pixel of a batch to the sums.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "lib/luminance.glsl"
#include "path/sum.glsl"

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathFinishParams params;
};

void main()
{
    uint slot = threadIndex();
    if (slot >= params.pixel_count)
        return;
    addSample(params.sums, params.first_pixel + slot, params.radiance.data[slot]);
}
