// SPDX-License-Identifier: MIT
// A simple sky for pictures without an environment.
#ifndef ZVO_SHADERS_LIB_SKY_GLSL
#define ZVO_SHADERS_LIB_SKY_GLSL

#include "shared/sky.h"

const float kSunDiscCosine = 0.9995; // 1.8 degrees from the middle to the edge
const float kForward = 0.7;          // of the haze around the sun: the mean cosine of the angles by which it scatters
const float kGlowAbove = 0.2;        // part of the glow that reaches up to the zenith
const float kHazeDepth = 14.0;       // how fast the ground comes out of the haze below the horizon
const float kHaze = 0.65;            // part of the ground's radiance that is haze at the horizon

// The light that haze scatters by an angle, over that straight ahead (L. Henyey, J. Greenstein, Diffuse Radiation in
// the Galaxy, 1941).
float glowOf(float cosine)
{
    float part = (1.0 - kForward) * (1.0 - kForward) / (1.0 + kForward * kForward - 2.0 * kForward * cosine);
    return part * sqrt(part);
}

// Radiance from direction (length 1), without the sun: deep above, bright at the horizon and around the sun. Below the
// horizon is ground, in haze far away.
vec3 skyRadiance(Sky sky, vec3 direction)
{
    float height = dot(direction, sky.up);
    float away = 1.0 - abs(height); // 1 at the horizon
    vec3 glow = glowOf(dot(direction, sky.to_sun)) * sky.glow;
    vec3 above = mix(sky.zenith, sky.horizon, away * away) + mix(kGlowAbove, 1.0, away * away * away * away) * glow;
    vec3 below = mix(sky.ground, sky.horizon + glow, kHaze * exp(kHazeDepth * min(height, 0.0)));
    return height > 0.0 ? above : below;
}

// Irradiance / pi that a surface with this normal (length 1) receives from the sky, without the sun.
vec3 skyAmbient(Sky sky, vec3 normal)
{
    return mix(sky.below, sky.above, 0.5 + 0.5 * dot(normal, sky.up));
}

float sunDisc(vec3 direction, vec3 to_sun)
{
    return smoothstep(kSunDiscCosine - 0.0004, kSunDiscCosine + 0.0002, dot(direction, to_sun));
}

#endif
