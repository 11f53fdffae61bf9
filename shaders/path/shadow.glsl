// SPDX-License-Identifier: MIT
// Lists of shadow rays.
// Needs the constant kSampling, params.bounce, params.lists, params.shadow_rays and params.shadow_states.
#ifndef ZVO_SHADERS_PATH_SHADOW_GLSL
#define ZVO_SHADERS_PATH_SHADOW_GLSL

#include "lib/ray.glsl"
#include "path/chosen_light.glsl"
#include "path/lists.glsl"
#include "path/path.h"

// Lists a shadow ray, unless it cannot bring light. Threads without a path take part, too.
void appendShadow(bool exists, vec3 origin, PathState state, ChosenDirection chosen)
{
    vec3 light = lightOfChoice(state, chosen);
    bool brings_light = exists && isLit(light);
    uint shadow = appendTo(params.bounce, kListShadows, brings_light);
    if (!brings_light)
        return;
    storeRay(params.shadow_rays, shadow, Ray(origin, 0.0, inverseDirection(chosen.direction), kTraceTimeMax));
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(params.shadow_states));
    words.data[3u * shadow] = packUint2x32(floatBitsToUint(light.xy));
    words.data[3u * shadow + 1u] = packUint2x32(uvec2(floatBitsToUint(light.z), state.slot));
    words.data[3u * shadow + 2u] = packUint2x32(chosen.target);
}

#endif
