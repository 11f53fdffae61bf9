// SPDX-License-Identifier: MIT
// Chosen lights. The includer includes path/path.h, path/face.glsl and path/weights.glsl before.
#ifndef ZVO_SHADERS_PATH_CHOSEN_GLSL
#define ZVO_SHADERS_PATH_CHOSEN_GLSL

#include "lib/face.glsl"
#include "path/path.h"
#include "path/weights.glsl"

// A light that was chosen for a place on a face.
struct ChosenDirection
{
    vec3 direction; // length 1
    float density;  // by solid angle, of choosing it; 0: no light can come from there
    vec3 light;     // radiance from there, if nothing is in the way
    uvec2 target;   // as in ShadowState
};

// What the chosen light brings to the pixel, if nothing is in the way. state: of the path, as it leaves the face.
vec3 lightOfChoice(PathState state, ChosenDirection chosen)
{
    const float pi = 3.14159265358979;
    float cosine = dot(normalAxis(state.normal), chosen.direction);
    vec3 light = vec3(0.0);
    if (chosen.density > 0.0 && cosine > 0.0)
        light = state.throughput * chosen.light *
                (cosine / (pi * chosen.density) * balance(chosen.density, cosine / pi));
    return light;
}

bool isLit(vec3 light)
{
    return max(light.r, max(light.g, light.b)) > 0.0;
}

#endif
