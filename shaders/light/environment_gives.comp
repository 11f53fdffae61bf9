#version 460
// SPDX-License-Identifier: MIT
// Computes how much light a face with each normal gets of the map and of the sun, at most: by which part light is looked
// for there.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"

GPU_ENTRY(EnvironmentGivesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kArgsGroup) in;

#include "lib/color.glsl"

void main()
{
    uint normal = gl_LocalInvocationIndex;
    if (normal >= kNormals)
        return;
    const float two_pi = 6.28318530717959;
    // Of a sun that sets, a part of the disc may still be above the face's horizon.
    float along = normal % 3u == 0u ? params.to_sun.x : normal % 3u == 1u ? params.to_sun.y : params.to_sun.z;
    float sine = sqrt(params.sun_height * (2.0 - params.sun_height));
    float cosine = min((normal < 3u ? along : -along) + sine, 1.0);
    float of_sun = max(cosine, 0.0) * two_pi * params.sun_height * luminance(params.sun);
    params.gives.data[normal] = vec2(params.strength * params.totals.data[0].irradiance[normal], of_sun);
}
