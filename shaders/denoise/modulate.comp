#version 460
// SPDX-License-Identifier: MIT
// Makes radiance of the filtered light. Where a pixel of few samples is still brighter than all around it, nothing was
// like it: it is dimmed to the brightest of them, the less the more samples it has.
#extension GL_GOOGLE_include_directive : require
#include "denoise/denoise.h"

GPU_ENTRY(DenoiseModulateParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "denoise/guide.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "path/pixel.glsl"

// The largest luminance of the eight pixels around one.
float brightestAround(ivec2 pixel)
{
    ivec2 size = ivec2(params.width, params.height);
    float brightest = 0.0;
    for (int k = 0; k < 9; ++k)
    {
        ivec2 other = pixel + ivec2(k % 3, k / 3) - 1;
        if (k != 4 && all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, size)))
            brightest = max(brightest, luminance(loadLight(params.light, uint(other.y * size.x + other.x)).rgb));
    }
    return brightest;
}

void main()
{
    uint i = threadIndex();
    if (i >= params.width * params.height)
        return;
    uint number = numberOfPixel(uvec2(i % params.width, i / params.width), uvec2(params.width, params.height));
    PixelFeatures sum = loadFeatures(params.features, number);
    vec3 light = loadLight(params.light, i).rgb;
    float brightest = brightestAround(ivec2(i % params.width, i / params.width));
    float dimmed = min(1.0, brightest / max(luminance(light), 1e-30));
    if (brightest > 0.0) // else there is nothing around
        light *= mix(dimmed, 1.0, min(1.0 / (params.sample_part * kSpikeSamples), 1.0));
    vec3 scattered = light * divisorOf(params.sample_part * sum.albedo);
    params.sums.data[number] = PixelSum(params.sample_part * sum.direct + scattered, 0.0);
}
