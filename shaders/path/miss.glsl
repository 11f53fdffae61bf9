// SPDX-License-Identifier: MIT
// Light from outside of the grid. The includer includes path/path.h, light/environment.glsl and path/weights.glsl before
// and declares kSampling and params.
#ifndef ZVO_SHADERS_PATH_MISS_GLSL
#define ZVO_SHADERS_PATH_MISS_GLSL

#include "light/environment.glsl"
#include "light/map_radiance.glsl"
#include "path/path.h"
#include "path/weights.glsl"

// What a ray that has left the grid brings to the pixel.
vec3 lightOfMiss(PathState state, Ray ray)
{
    vec3 direction = normalize(1.0 / ray.inverse_direction);
    float map_density = 0.0;
    if (kSampling == kSampleBoth)
        map_density = state.kinds.x * mapDensity(params.environment, state.normal, direction);
    vec3 light = mapRadiance(params.environment, direction) * chanceWeight(state, map_density);
    if (meetsSun(params.environment, direction))
        light += params.environment.data[0].sun * chanceWeight(state, state.kinds.y * sunDensity(params.environment));
    return state.throughput * light;
}

#endif
