// SPDX-License-Identifier: MIT
// Light from outside of the grid: what a ray meets, and what is chosen.
// Needs the constants kSampling and kSmooth, params.environment, params.lists and params.sample_index.
#ifndef ZVO_SHADERS_PATH_MAP_LIGHT_GLSL
#define ZVO_SHADERS_PATH_MAP_LIGHT_GLSL

#include "lib/sampling.glsl"
#include "light/environment.glsl"
#include "light/outside.glsl"
#include "path/chosen_light.glsl"
#include "path/normal.glsl"
#include "path/path.h"
#include "path/state.glsl"

// The density with which a direction to the map is chosen for a surface.
float densityOfMap(uint normal, vec3 direction)
{
    if (isFaceNormal(normal))
        return mapDensity(params.environment, normal, direction);
    vec3 surface_normal = normalOf(normal);
    float density = 0.0;
    for (uint axis = 0u; axis < 3u; ++axis)
    {
        float along = componentOf(surface_normal, axis);
        density += along * along * mapDensity(params.environment, faceAlong(axis, surface_normal), direction);
    }
    return density;
}

// What a ray that has left the grid brings to the pixel.
vec3 lightOfMiss(PathState state, Ray ray)
{
    vec3 direction = normalize(1.0 / ray.inverse_direction);
    float map_density = 0.0;
    if (kSampling == kSampleBoth)
        map_density = state.kinds.x * densityOfMap(state.normal, direction);
    bool by_camera = state.density == 0.0;
    vec3 light = mapRadiance(params.environment, direction, by_camera) * chanceWeight(state, map_density);
    if (meetsSun(params.environment, direction))
        light += params.environment.data[0].sun * chanceWeight(state, state.kinds.y * sunDensity(params.environment));
    return state.throughput * light;
}

// A direction to the map, or to the sun, for a path that leaves a surface. Where that has any normal, the random number
// that ends later paths chooses a face.
ChosenDirection chooseMapLight(PathState state, uint bounce)
{
    uint pair = bounce * kPathPairs;
    vec2 point = samplePair(params.sample_index, state.seed, pair + kPairPoint);
    ChosenDirection chosen;
    chosen.target = uvec2(kNoTarget);
    vec2 other = samplePair(params.sample_index, state.seed, pair + kPairOther);
    if (other.x < state.kinds.x)
    {
        bool is_face = isFaceNormal(state.normal);
        uint face = is_face ? state.normal : chosenFace(normalOf(state.normal), other.y);
        uvec2 choice = sampleBits(params.sample_index, state.seed, pair + kPairChoice);
        chosen.direction = chooseMapDirection(params.environment, face, choice, point, chosen.density);
        if (!is_face)
            chosen.density = densityOfMap(state.normal, chosen.direction);
        chosen.density *= state.kinds.x;
        chosen.light = mapRadiance(params.environment, chosen.direction);
    }
    else
    {
        chosen.direction = chooseSunDirection(params.environment, point);
        chosen.density = state.kinds.y * sunDensity(params.environment);
        chosen.light = params.environment.data[0].sun;
    }
    return chosen;
}

#endif
