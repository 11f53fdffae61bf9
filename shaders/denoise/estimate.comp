#version 460
// SPDX-License-Identifier: MIT
// Begins the filter: takes the mean over those of the 3x3 pixels around each that show the same face of a voxel, and
// estimates its variance, from the samples of these pixels, or where they are few, from how the pixels differ.
#extension GL_GOOGLE_include_directive : require
#include "denoise/denoise.h"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/luminance.glsl"
#include "denoise/guide.glsl"

layout(constant_id = 0) const bool kOrthographic = false;

layout(local_size_x = kDenoiseTile * kDenoiseTile) in;
layout(push_constant, scalar) uniform Push
{
    DenoiseFilterParams params;
};

const float kFewSamples = 4.0;

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
        storeLight(params.filtered, center, vec4(light.rgb, 0.0));
        return;
    }
    vec3 place = placeOf(pixel, guide.depth);
    float weights = 0.0;
    float within = 0.0;       // variance of pixels, by the samples of each
    vec2 moments = vec2(0.0); // of the light of pixels: how they differ
    float face_weights = 0.0; // of the same face of a voxel, as far as it is here
    float face_squares = 0.0;
    vec3 face_light = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
    {
        for (int x = -1; x <= 1; ++x)
        {
            ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(size) - 1);
            uint index = uint(other.y) * params.width + uint(other.x);
            Guide other_guide = loadGuide(params.guides, index);
            vec4 other_light = loadLight(params.light, index);
            vec3 way = placeOf(other, other_guide.depth) - place;
            float mean = luminance(other_light.rgb);
            float weight = alikeness(guide, other_guide, way, params.edge);
            weights += weight;
            within += weight * max(other_light.w - mean * mean, 0.0) / max(params.samples.data[index] - 1.0, 1.0);
            moments += weight * vec2(mean, mean * mean);
            weight *= exp(-dot(way, way) / (params.edge * params.edge));
            face_weights += weight;
            face_squares += weight * weight;
            face_light += weight * other_light.rgb;
        }
    }
    moments /= weights;
    float variance = within / weights;
    if (params.samples.data[center] < kFewSamples)
        variance = max(variance, moments.y - moments.x * moments.x);
    storeLight(params.filtered, center,
               vec4(face_light / face_weights, variance * face_squares / (face_weights * face_weights)));
}
