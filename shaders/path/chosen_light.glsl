// SPDX-License-Identifier: MIT
// Chosen lights, the shadow rays to them, and the weights of light that can be found in two ways (path/path.h).
// Needs the constants kSampling and kSmooth, and params.lists.
#ifndef ZVO_SHADERS_PATH_CHOSEN_LIGHT_GLSL
#define ZVO_SHADERS_PATH_CHOSEN_LIGHT_GLSL

#include "lib/ray.glsl"
#include "path/lists.glsl"
#include "path/normal.glsl"
#include "path/path.h"

// The weight of light that was found in one way, by the densities of this and the other way.
float balance(float own, float other)
{
    if (kSampling == kSampleBoth)
        return own / (own + other);
    return 1.0;
}

// The weight of light that a ray has met, which light sampling would have chosen with this density.
float chanceWeight(PathState state, float light_density)
{
    if (state.density == 0.0)
        return 1.0;
    return kSampling == kSampleLights ? 0.0 : balance(state.density, light_density);
}

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
    float cosine = dot(normalOf(state.normal), chosen.direction);
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

// Lists a shadow ray, unless it cannot bring light. rays, states: the list's. Threads without a path take part, too.
void appendShadow(Ray_Ptr rays, ShadowState_Ptr states, uint bounce, bool exists, vec3 origin, PathState state,
                  ChosenDirection chosen)
{
    vec3 light = lightOfChoice(state, chosen);
    bool brings_light = exists && isLit(light);
    uint shadow = appendTo(bounce, kListShadows, brings_light);
    if (!brings_light)
        return;
    storeRay(rays, shadow, Ray(origin, 0.0, inverseDirection(chosen.direction), kTraceTimeMax));
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(states));
    words.data[3u * shadow] = packUint2x32(floatBitsToUint(light.xy));
    words.data[3u * shadow + 1u] = packUint2x32(uvec2(floatBitsToUint(light.z), state.slot));
    words.data[3u * shadow + 2u] = packUint2x32(chosen.target);
}

#endif
