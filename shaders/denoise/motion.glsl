// SPDX-License-Identifier: MIT
// Where a camera sees a place. The includer includes shared/trace.h before.
#ifndef ZVO_SHADERS_DENOISE_MOTION_GLSL
#define ZVO_SHADERS_DENOISE_MOTION_GLSL

#include "shared/trace.h"

// Coordinates in pixels, whole numbers at the pixels' centres, of a place from the camera's origin; far outside if it
// is behind the camera.
vec2 pixelOfPlace(vec3 place, uvec2 size, bool orthographic, CameraRays camera)
{
    float depth = dot(place, camera.forward);
    vec3 offset = orthographic ? place : place / depth;
    vec2 n = vec2(dot(offset, camera.half_pixel_x) / dot(camera.half_pixel_x, camera.half_pixel_x),
                  dot(offset, camera.half_pixel_y) / dot(camera.half_pixel_y, camera.half_pixel_y));
    return !orthographic && depth <= 0.0 ? vec2(-1e6) : 0.5 * (n + vec2(size)) - 0.5;
}

#endif
