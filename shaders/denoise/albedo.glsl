// SPDX-License-Identifier: MIT
// Division by the albedo. Where a channel of it is dark, the light is not known well in that channel. The includer
// includes denoise/denoise.h before.
#ifndef ZVO_SHADERS_DENOISE_ALBEDO_GLSL
#define ZVO_SHADERS_DENOISE_ALBEDO_GLSL

#include "denoise/denoise.h"

bool isDark(vec3 albedo)
{
    return max(max(albedo.r, albedo.g), albedo.b) < kDarkest;
}

// By what light is divided, and multiplied again: the albedo, unless all of it is dark.
vec3 divisorOf(vec3 albedo)
{
    return isDark(albedo) ? vec3(kDarkest) : max(albedo, vec3(1e-6));
}

// Light in the channels that are dark is taken from the others.
vec3 lightOf(vec3 scattered, vec3 albedo)
{
    vec3 light = scattered / divisorOf(albedo);
    vec3 known = vec3(greaterThanEqual(albedo, vec3(kDarkest)));
    float known_count = dot(known, vec3(1.0));
    return known_count == 0.0 ? light : mix(vec3(dot(light, known) / known_count), light, known);
}

#endif
