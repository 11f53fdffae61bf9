#version 460
// SPDX-License-Identifier: MIT
// Divides the light of each pixel by its albedo, and makes its guide.
#extension GL_GOOGLE_include_directive : require
#include "denoise/denoise.h"

GPU_ENTRY(DenoiseDemodulateParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "denoise/guide.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "path/pixel.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.width * params.height)
        return;
    uint number = numberOfPixel(uvec2(i % params.width, i / params.width), uvec2(params.width, params.height));
    PixelFeatures sum = loadFeatures(params.features, number);
    float part = 1.0 / params.sample_count;
    vec3 scattered = part * max(params.sums.data[number].radiance - sum.direct, 0.0);
    vec3 albedo = part * sum.albedo;
    float mean = min(luminance(scattered), kBrightest);
    float spread = max(min(part * sum.scattered_squared, kBrightest * kBrightest) - mean * mean, 0.0);
    float scale = luminance(divisorOf(albedo));
    vec3 light = min(lightOf(scattered, albedo), kBrightest);
    float light_mean = luminance(light);
    storeLight(params.light, i, vec4(light, light_mean * light_mean + spread / (scale * scale)));
    vec3 normal = sum.normal / max(sum.hits, 1.0);
    float coverage = isDark(albedo) ? 0.0 : part * sum.hits;
    uint64_t_Ptr(uint64_t(params.guides)).data[i] =
        packUint2x32(uvec2(floatBitsToUint(sum.depth / max(sum.hits, 1.0)), packSurface(normal, coverage)));
    params.samples.data[i] = params.sample_count;
}
