#version 460
// SPDX-License-Identifier: MIT
// Fills a picture with the sky alone, or with black.
#extension GL_GOOGLE_include_directive : require
#include "trace/light.h"

GPU_ENTRY(SkyParams, TRACE_SKY_CONSTANTS);
layout(local_size_x = kSkyGroup) in;

#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/sky.glsl"
#include "trace/texel.glsl"

const float kSunDisc = 4.0; // radiance of the sun's disc by its strength

vec3 skyColor(uvec2 pixel, uvec2 size)
{
    if (kBlack)
        return vec3(0.0);
    vec3 direction = params.forward;
    if (!kOrthographic)
        direction += rayOffset(pixelOffset(pixel, size), params.half_pixel_x, params.half_pixel_y);
    direction = normalize(direction);
    Sky sky = params.sky.data[0];
    vec3 radiance = skyRadiance(sky, direction) + kSunDisc * params.sun * sunDisc(direction, sky.to_sun) * sky.sun;
    return developTexel(kTexels, radiance, params.exposure, pixel);
}

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    uint column = threadIndex() % size.x;
    uint first = threadIndex() / size.x * kSkyRows;
    uint last = min(first + kSkyRows, size.y);
    for (uint y = first; y < last; ++y)
        storeTexel(kTexels, params.image, y * size.x + column, skyColor(uvec2(column, y), size));
}
