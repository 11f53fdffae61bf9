#version 460
// SPDX-License-Identifier: MIT
// Makes the picture of the mean of all samples.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathDevelopParams, PATH_DEVELOP_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "path/pixel.glsl"
#include "trace/texel.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.width * params.height)
        return;
    uvec2 pixel = uvec2(i % params.width, i / params.width);
    uint number = numberOfPixel(pixel, uvec2(params.width, params.height));
    vec3 radiance = params.sample_part * params.sums.data[number].radiance;
    storeTexel(kTexels, params.image, i, developTexel(kTexels, radiance, params.exposure.data[0], pixel));
}
