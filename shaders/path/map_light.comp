#version 460
// SPDX-License-Identifier: MIT
// Chooses a direction to the map, or to the sun, for each path of a list, and lists a shadow ray.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathLightParams, PATH_MAP_LIGHT_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "lib/ray.glsl"
#include "path/state.glsl"
#include "path/chosen_light.glsl"
#include "path/lists.glsl"
#include "path/map_light.glsl"

void main()
{
    uint i = threadIndex();
    uint length = listLength(params.bounce, kListMapLights);
    bool exists = i < length;
    uint path = params.numbers.data[min(i, length - 1u)];
    PathState state = loadState(params.states, path);
    vec3 origin = loadRay(params.rays, path).origin;
    ChosenDirection chosen = chooseMapLight(state, params.bounce);
    appendShadow(params.shadow_rays, params.shadow_states, params.bounce, exists, origin, state, chosen);
}
