#version 460
// SPDX-License-Identifier: MIT
// Adds a sample of each pixel of a batch to the sums.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "lib/luminance.glsl"

layout(constant_id = 0) const bool kFeatures = false;

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
    vec3 radiance = params.radiance.data[slot];
    float light = luminance(radiance);
    if (kFeatures)
    {
        float scattered = light - params.direct.data[slot];
        params.features.data[params.first_pixel + slot].scattered_squared += scattered * scattered;
    }
    PixelSum sum = params.sums.data[params.first_pixel + slot];
    params.sums.data[params.first_pixel + slot] =
        PixelSum(sum.radiance + radiance, sum.luminance_squared + light * light);
}
