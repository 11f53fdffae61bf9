#version 460
// SPDX-License-Identifier: MIT
// Chooses a direction to the map, or to the sun, for each path of a list, and lists a shadow ray.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "lib/ray.glsl"
#include "lib/sobol.glsl"
#include "light/environment.glsl"
#include "path/face.glsl"
#include "path/numbers.glsl"

layout(constant_id = 0) const uint kSampling = kSampleBoth; // how light is found

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathLightParams params;
};

#include "path/lists.glsl"
#include "path/state.glsl"
#include "path/weights.glsl"
#include "path/shadow.glsl"

void main()
{
    uint i = threadIndex();
    uint length = listLength(params.bounce, kListMapLights);
    bool exists = i < length;
    uint path = params.numbers.data[kListMapLights * params.batch + min(i, length - 1u)];
    PathState state = loadState(params.states, path);
    vec3 origin = loadRay(params.rays, path).origin;
    vec3 normal = normalAxis(state.normal);
    uint pair = params.bounce * kPathPairs;
    vec2 point = samplePair(params.sample_index, state.seed, pair + kPairPoint);
    ChosenDirection chosen;
    chosen.target = uvec2(kNoTarget);
    if (samplePair(params.sample_index, state.seed, pair + kPairOther).x < state.kinds.x)
    {
        uvec2 choice = sampleBits(params.sample_index, state.seed, pair + kPairChoice);
        chosen.direction = chooseMapDirection(params.environment, state.normal, choice, point, chosen.density);
        chosen.density *= state.kinds.x;
        chosen.light = mapRadiance(params.environment, chosen.direction);
    }
    else
    {
        chosen.direction = chooseSunDirection(params.environment, point);
        chosen.density = state.kinds.y * sunDensity(params.environment);
        chosen.light = params.environment.data[0].sun;
    }
    appendShadow(exists, origin, state, normal, chosen);
}
