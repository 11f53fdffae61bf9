// SPDX-License-Identifier: MIT
// Rays from the camera.
// Needs the constant kOrthographic.
#ifndef ZVO_SHADERS_PATH_CAMERA_RAY_GLSL
#define ZVO_SHADERS_PATH_CAMERA_RAY_GLSL

#include "lib/camera.glsl"
#include "lib/ray.glsl"
#include "lib/sampling.glsl"
#include "path/path.h"
#include "path/state.glsl"

// The seed of a pixel's random numbers.
uint seedOfPixel(PathView view, uvec2 pixel)
{
    return hashPair(hashPair(view.seed, pixel.y), pixel.x);
}

// A ray from a random point of the lens through one of a pixel. seed: of the pixel.
Ray cameraRay(PathView view, uvec2 pixel, uint seed, uint sample_index)
{
    const float two_pi = 6.28318530717959;
    vec2 jitter = samplePair(sample_index, seed, kPairPixel);
    vec2 lens = samplePair(sample_index, seed, kPairLens);

    vec2 offset = pixelOffset(pixel, uvec2(view.width, view.height)) + 2.0 * jitter - 1.0;
    vec3 through = rayOffset(offset, view.camera.half_pixel_x, view.camera.half_pixel_y);
    vec3 origin = view.camera.origin + (kOrthographic ? through : vec3(0.0));
    vec3 direction = view.camera.forward + (kOrthographic ? vec3(0.0) : through);
    float radius = view.lens_radius * sqrt(lens.x);
    vec3 shift = radius * (cos(two_pi * lens.y) * normalize(view.camera.half_pixel_x) +
                           sin(two_pi * lens.y) * normalize(view.camera.half_pixel_y));
    // What is in focus stays where it is.
    origin += shift;
    direction -= shift / view.focus;
    return Ray(origin, 0.0, inverseDirection(normalize(direction)), kTraceTimeMax);
}

#endif
