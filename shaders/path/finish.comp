#version 460
// SPDX-License-Identifier: MIT
// Adds a sample of each pixel of a batch to the sums.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathFinishParams, PATH_FINISH_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "path/pixel.glsl"

void main()
{
    uint slot = threadIndex();
    if (slot >= params.pixel_count)
        return;
    uint pixel = params.first_pixel + slot;
    vec3 radiance = params.radiance.data[slot];
    addSample(params.sums, pixel, radiance);
    if (kFeatures)
        addScattered(params.features, pixel, radiance, params.direct.data[slot]);
}
