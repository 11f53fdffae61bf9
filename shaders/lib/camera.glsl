// SPDX-License-Identifier: MIT
// Rays of a picture's pixels, the tiles that they are traced in, and where a camera sees a place.
#ifndef ZVO_SHADERS_LIB_CAMERA_GLSL
#define ZVO_SHADERS_LIB_CAMERA_GLSL

#include "shared/trace.h"

// Twice the offset of a pixel's centre from the picture's, in pixels: exact.
vec2 pixelOffset(uvec2 pixel, uvec2 size)
{
    return vec2(ivec2(2u * pixel + 1u) - ivec2(size));
}

vec3 rayOffset(vec2 offset, vec3 half_pixel_x, vec3 half_pixel_y)
{
    precise vec3 sum = offset.x * half_pixel_x + offset.y * half_pixel_y;
    return sum;
}

// Pixel of a thread within its tile: eight consecutive threads take 4x2 pixels, sixteen 4x4 and so on.
uvec2 pixelInTile(uint thread)
{
    uvec2 bits = uvec2(thread, thread >> 1);
    return (bits & 1u) | ((bits >> 1) & 2u) | ((bits >> 2) & 4u);
}

// A tile of a picture as lists of tiles have it: x | y << 16.
uint packTile(uvec2 tile)
{
    return tile.x | (tile.y << 16);
}

uvec2 unpackTile(uint tile)
{
    return uvec2(bitfieldExtract(tile, 0, 16), tile >> 16);
}

// Coordinates in pixels, whole numbers at the pixels' centres, of a place from the camera's origin; far outside if it
// is behind the camera.
vec2 pixelOfPlace(vec3 place, uvec2 size, bool orthographic, PictureCamera camera)
{
    CameraRays rays = camera.rays;
    float depth = dot(place, camera.axis);
    vec3 offset = orthographic ? place : place / depth - (rays.forward - camera.axis);
    vec2 n = vec2(dot(offset, rays.half_pixel_x) / dot(rays.half_pixel_x, rays.half_pixel_x),
                  dot(offset, rays.half_pixel_y) / dot(rays.half_pixel_y, rays.half_pixel_y));
    return !orthographic && depth <= 0.0 ? vec2(-1e6) : 0.5 * (n + vec2(size)) - 0.5;
}

#endif
