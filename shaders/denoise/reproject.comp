#version 460
// SPDX-License-Identifier: MIT
// Adds the light of an earlier picture where it shows the same place.
#extension GL_GOOGLE_include_directive : require
#include "denoise/denoise.h"

GPU_ENTRY(DenoiseReprojectParams, DENOISE_REPROJECT_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "denoise/guide.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint i = threadIndex();
    uvec2 size = uvec2(params.width, params.height);
    if (i >= size.x * size.y)
        return;
    Guide guide = loadGuide(params.guides, i);
    if (guide.coverage == 0.0)
        return;
    CameraRays now = params.cameras.data[0].rays;
    PictureCamera camera_before = params.cameras.data[1];
    CameraRays before = camera_before.rays;
    ivec2 pixel = ivec2(i % size.x, i / size.x);
    vec3 place = now.origin - before.origin +
                 placeAt(pixel, guide.depth, size, kOrthographic, now.forward, now.half_pixel_x, now.half_pixel_y);
    vec2 old_pixel = pixelOfPlace(place, size, kOldOrthographic, camera_before);
    ivec2 low = ivec2(floor(clamp(old_pixel, vec2(-2.0), vec2(size) + 1.0)));
    vec2 part = old_pixel - vec2(low);

    vec4 sum = vec4(0.0);
    float samples = 0.0;
    float weights = 0.0;
    for (int corner = 0; corner < 4; ++corner)
    {
        ivec2 side = ivec2(corner & 1, corner >> 1);
        ivec2 other = low + side;
        bool exists = all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, ivec2(size)));
        other = clamp(other, ivec2(0), ivec2(size) - 1);
        uint index = uint(other.y) * size.x + uint(other.x);
        Guide other_guide = loadGuide(params.old_guides, index);
        vec3 way = placeAt(other, other_guide.depth, size, kOldOrthographic, before.forward, before.half_pixel_x,
                           before.half_pixel_y) - place;
        vec2 share = mix(1.0 - part, part, vec2(side));
        float apart = hasPlane(guide) ? distanceFromPlane(guide, way, params.edge) : length(way) / params.edge;
        bool same = exists && other_guide.coverage > 0.0 && apart < kDistanceMax &&
                    turnOf(guide, other_guide) < kTurnMax;
        float weight = same ? share.x * share.y * other_guide.coverage : 0.0;
        weights += weight;
        sum += weight * loadLight(params.old_light, index);
        samples += weight * params.old_samples.data[index];
    }
    if (!(weights > 0.01))
        return;
    float old_samples = min(samples / weights, params.history_max);
    float new_samples = params.samples.data[i];
    vec4 light = loadLight(vec4_ConstPtr(uint64_t(params.light)), i);
    storeLight(params.light, i, mix(light, sum / weights, old_samples / (old_samples + new_samples)));
    params.samples.data[i] = old_samples + new_samples;
}
