#version 460
// SPDX-License-Identifier: MIT
// Adds the light of lamps, or from outside of the grid, to the pixels that see it directly.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceDirectParams, RADIANCE_DIRECT_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/hit.glsl"
#include "light/environment.glsl"
#include "light/outside.glsl"
#include "path/pixel.glsl"

#define HITS_BINDING 0
#include "path/lists.glsl"
#include "radiance/hits.glsl"

// Light from outside of the grid, from a direction (length 1).
vec3 outside(vec3 direction)
{
    vec3 sun = meetsSun(params.environment, direction) ? params.environment.data[0].sun : vec3(0.0);
    return mapRadiance(params.environment, direction, true) + sun;
}

void main()
{
    uint i = threadIndex();
    if (i >= listLength(0u, kListMisses))
        return;
    uvec2 size = uvec2(params.width, params.height);
    uint number = params.direct.data[i];
    uvec2 pixel = pixelOfNumber(number, size);
    Hit hit = seenHit(params.starts, params.width, pixel);
    vec3 direction = params.forward;
    if (!kOrthographic)
        direction += rayOffset(pixelOffset(pixel, size), params.half_pixel_x, params.half_pixel_y);
    vec3 light = outside(normalize(direction));
    if (kEmission && !isMiss(hit))
        light = emissionOf(params.tree, hit.index);
    addRadiance(params.sums, number, light);
}
