#version 460
// SPDX-License-Identifier: MIT
// Starts a path for each pixel of a batch, with a ray from a random point of the lens through one of the pixel.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/dispatch_args.glsl"
#include "lib/ray.glsl"
#include "lib/sobol.glsl"
#include "path/numbers.glsl"
#include "path/state.glsl"
#include "path/strip.glsl"

layout(constant_id = 0) const bool kOrthographic = false;

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathBeginParams params;
};

const float kTwoPi = 6.28318530717959;

void main()
{
    uint slot = threadIndex();
    if (slot >= params.pixel_count)
        return;
    if (slot == 0u)
    {
        params.lists.data[kListPaths] = foldedArgs((params.pixel_count + kPathGroup - 1u) / kPathGroup, kTilesFold);
        params.lists.data[kListLengths].x = params.pixel_count;
    }
    uvec2 size = uvec2(params.width, params.height);
    uvec2 pixel = pixelOfNumber(params.first_pixel + slot, size);
    uint seed = hashPair(hashPair(params.seed, pixel.y), pixel.x);
    vec2 jitter = samplePair(params.sample_index, seed, kPairPixel);
    vec2 lens = samplePair(params.sample_index, seed, kPairLens);

    vec2 offset = pixelOffset(pixel, size) + 2.0 * jitter - 1.0;
    vec3 through = rayOffset(offset, params.camera.half_pixel_x, params.camera.half_pixel_y);
    vec3 origin = params.camera.origin + (kOrthographic ? through : vec3(0.0));
    vec3 direction = params.camera.forward + (kOrthographic ? vec3(0.0) : through);
    float radius = params.lens_radius * sqrt(lens.x);
    vec3 shift = radius * (cos(kTwoPi * lens.y) * normalize(params.camera.half_pixel_x) +
                           sin(kTwoPi * lens.y) * normalize(params.camera.half_pixel_y));
    // What is in focus stays where it is.
    origin += shift;
    direction -= shift / params.focus;

    storeRay(params.rays, slot, Ray(origin, 0.0, inverseDirection(normalize(direction)), kTraceTimeMax));
    storeState(params.states, slot, PathState(vec3(1.0), slot, seed, 0u, 0.0, vec3(0.0)));
    params.radiance.data[slot] = vec3(0.0);
}
