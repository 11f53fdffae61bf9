#version 460
// SPDX-License-Identifier: MIT
// Computes the pixels of a lit picture from hits, one workgroup for each live tile: sun with shadow, sky light,
// emission. Pixels without a hit keep what trace/sky has written.
#extension GL_GOOGLE_include_directive : require
#include "trace/light.h"

GPU_ENTRY(ShadeParams, TRACE_SHADE_CONSTANTS);
layout(local_size_x = kTilePixels) in;

#include "lib/camera.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/sky.glsl"
#include "trace/surface.glsl"
#include "trace/texel.glsl"

const float kBounced = 0.12; // part of the sky's light that other surfaces reflect even into closed corners

vec3 emissionAt(uint voxel)
{
    uvec2 word = params.emission_words.data[voxel >> 5];
    uint bit = 1u << (voxel & 31u);
    if ((word.x & bit) == 0u)
        return vec3(0.0);
    uint rank = word.y + bitCount(word.x & (bit - 1u));
    return params.emission_scale * decodeRgb9e5(params.emission.data[rank]);
}

vec3 lit(Surface surface, vec3 emission, uint light)
{
    Sky outside = params.sky.data[0];
    float sun = params.sun * max(dot(surface.normal, outside.to_sun), 0.0) * float(light & kLightSun) / 255.0;
    float sky = mix(kBounced, 1.0, float(light >> kLightSkyShift) / 255.0);
    return surface.albedo * (sun * outside.sun + sky * skyAmbient(outside, surface.normal)) + emission;
}

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    uvec2 tile = params.live.data[workgroupIndex()];
    if (tile.x == kNoTile)
        return;
    uvec2 pixel = kTileEdge * unpackTile(tile.x) + pixelInTile(gl_LocalInvocationIndex);
    if (any(greaterThanEqual(pixel, size)))
        return;
    uint i = pixel.y * size.x + pixel.x;
    Hit hit = loadHit(params.hits, i);
    if (isMiss(hit))
        return;
    uint light = kLight ? params.light.data[i] : kLightAll;
    vec3 direction = params.forward;
    if (!kOrthographic)
        direction += rayOffset(pixelOffset(pixel, size), params.half_pixel_x, params.half_pixel_y);
    Surface surface = surfaceAt(hit, direction, params.attributes, params.node_attributes);
    if (!kSmooth)
        surface.normal = faceNormal(hitFace(hit), direction);
    vec3 emission = kEmission && surface.may_emit ? emissionAt(hit.index) : vec3(0.0);
    storeTexel(kTexels, params.image, i, developTexel(kTexels, lit(surface, emission, light), params.exposure, pixel));
}
