#version 460
// SPDX-License-Identifier: MIT
// One level of the filter: 5x5 pixels that are params.step pixels apart.
#extension GL_GOOGLE_include_directive : require
#include "denoise/denoise.h"

GPU_ENTRY(DenoiseFilterParams, DENOISE_FILTER_CONSTANTS);
layout(local_size_x = kDenoiseTile * kDenoiseTile) in;

#include "denoise/guide.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"

// How many standard deviations two pixels of the same light may differ by: more where few samples tell the deviation.
float noiseOf(float samples)
{
    return min(kNoiseLeast + kNoiseFew / samples, kNoiseMost);
}

// The cubic B-spline at -2, -1, 0, 1, 2.
float spline(int x)
{
    return x == 0 ? 0.375 : abs(x) == 1 ? 0.25 : 0.0625;
}

// A place at a pixel, from the camera's origin.
vec3 placeOf(ivec2 pixel, float depth)
{
    return placeAt(pixel, depth, uvec2(params.width, params.height), kOrthographic, params.forward, params.half_pixel_x,
                   params.half_pixel_y);
}

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    ivec2 pixel = pixelOfThread(workgroupIndex(), gl_LocalInvocationIndex, params.width);
    if (any(greaterThanEqual(uvec2(pixel), size)))
        return;
    uint center = uint(pixel.y) * params.width + uint(pixel.x);
    Guide guide = loadGuide(params.guides, center);
    vec4 light = loadLight(params.light, center);
    if (guide.coverage == 0.0)
    {
        storeLight(params.filtered, center, light);
        return;
    }
    vec3 place = placeOf(pixel, guide.depth);
    float mean = luminance(light.rgb);
    float tolerance = 1.0 / (noiseOf(params.samples.data[center]) * sqrt(light.w) + 1e-3 * mean + 1e-30);
    float weights = 0.0;
    vec4 sum = vec4(0.0);
    for (int y = -2; y <= 2; ++y)
    {
        for (int x = -2; x <= 2; ++x)
        {
            ivec2 other = pixel + int(params.step) * ivec2(x, y);
            bool exists = all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, ivec2(size)));
            other = exists ? other : pixel;
            uint index = uint(other.y) * params.width + uint(other.x);
            Guide other_guide = loadGuide(params.guides, index);
            vec4 other_light = loadLight(params.light, index);
            vec3 way = placeOf(other, other_guide.depth) - place;
            float weight = exists ? spline(x) * spline(y) * alikeness(guide, other_guide, way, params.edge) : 0.0;
            weight *= exp(-abs(luminance(other_light.rgb) - mean) * tolerance);
            weights += weight;
            sum += vec4(weight, weight, weight, weight * weight) * other_light;
        }
    }
    storeLight(params.filtered, center, sum / vec4(vec3(weights), weights * weights));
}
