#version 460
// SPDX-License-Identifier: MIT
// Begins the filter: takes the mean over those of the 3x3 pixels around each that are alike and less than about a voxel
// away, and estimates its variance from the samples of these pixels, or, where they are few, from how the pixels
// differ.
#extension GL_GOOGLE_include_directive : require
#include "denoise/denoise.h"

GPU_ENTRY(DenoiseFilterParams, DENOISE_ESTIMATE_CONSTANTS);
layout(local_size_x = kDenoiseTile * kDenoiseTile) in;

#include "denoise/guide.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"

// A place at a pixel, from the camera's origin.
vec3 placeOf(ivec2 pixel, float depth)
{
    return placeAt(pixel, depth, uvec2(params.width, params.height), kOrthographic, params.forward, params.half_pixel_x,
                   params.half_pixel_y);
}

struct Neighbour
{
    vec3 light;
    float mean;     // luminance of the light
    float variance; // of the mean, by its samples
    float weight;   // how much it tells of the pixel in the middle; 0 outside of the picture
    float nearness; // from 0 to 1, by the distance in voxels
};

Neighbour loadNeighbour(ivec2 pixel, Guide guide, vec3 place)
{
    ivec2 inside = clamp(pixel, ivec2(0), ivec2(params.width, params.height) - 1);
    uint index = uint(inside.y) * params.width + uint(inside.x);
    Guide other = loadGuide(params.guides, index);
    vec4 light = loadLight(params.light, index);
    vec3 way = placeOf(inside, other.depth) - place;
    float mean = luminance(light.rgb);
    float variance = max(light.w - mean * mean, 0.0) / max(params.samples.data[index] - 1.0, 1.0);
    float weight = inside == pixel ? alikeness(guide, other, way, params.edge) : 0.0;
    return Neighbour(light.rgb, mean, variance, weight, exp(-dot(way, way) / (params.edge * params.edge)));
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
        storeLight(params.filtered, center, vec4(light.rgb, 0.0));
        return;
    }
    vec3 place = placeOf(pixel, guide.depth);

    float weights = 0.0;
    float variance = 0.0;
    vec2 moments = vec2(0.0); // of the means: how pixels differ
    for (int k = 0; k < 9; ++k)
    {
        Neighbour other = loadNeighbour(pixel + ivec2(k % 3, k / 3) - 1, guide, place);
        weights += other.weight;
        variance += other.weight * other.variance;
        moments += other.weight * vec2(other.mean, other.mean * other.mean);
    }
    variance /= weights;
    moments /= weights;
    if (params.samples.data[center] < kFewSamples)
        variance = max(variance, moments.y - moments.x * moments.x);

    float mean = luminance(light.rgb);
    float tolerance = 1.0 / (kNearNoise * sqrt(variance) + 1e-30);
    float squares = 0.0;
    vec3 sum = vec3(0.0);
    weights = 0.0;
    for (int k = 0; k < 9; ++k)
    {
        Neighbour other = loadNeighbour(pixel + ivec2(k % 3, k / 3) - 1, guide, place);
        float weight = other.weight * other.nearness * exp(-abs(other.mean - mean) * tolerance);
        weights += weight;
        squares += weight * weight;
        sum += weight * other.light;
    }
    storeLight(params.filtered, center, vec4(sum / weights, variance * squares / (weights * weights)));
}
