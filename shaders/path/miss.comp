#version 460
// SPDX-License-Identifier: MIT
// Adds the light from outside of the grid that rays have met.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "light/environment.glsl"

layout(constant_id = 0) const uint kSampling = kSampleBoth; // how light is found

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathLightParams params;
};

#include "path/lists.glsl"
#include "path/state.glsl"
#include "path/weights.glsl"

// Light from outside of the grid.
vec3 lightOfMiss(PathState state, vec3 direction)
{
    float map_density = 0.0;
    if (kSampling == kSampleBoth)
        map_density = state.kinds.x * mapDensity(params.environment, state.normal, direction);
    vec3 light = mapRadiance(params.environment, direction) * chanceWeight(state, map_density);
    if (meetsSun(params.environment, direction))
        light += params.environment.data[0].sun * chanceWeight(state, state.kinds.y * sunDensity(params.environment));
    return light;
}

void main()
{
    uint i = threadIndex();
    if (i >= listLength(params.bounce, kListMisses))
        return;
    uint path = params.numbers.data[kListMisses * params.batch + i];
    PathState state = loadState(params.states, path);
    Ray ray = loadRay(params.rays, path);
    vec3 direction = normalize(1.0 / ray.inverse_direction);
    params.radiance.data[state.slot] += state.throughput * lightOfMiss(state, direction);
}
