#version 460
// SPDX-License-Identifier: MIT
// Adds the light from outside of the grid that rays have met.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathLightParams, PATH_MISS_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "lib/ray.glsl"
#include "path/state.glsl"
#include "path/lists.glsl"
#include "path/map_light.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= listLength(params.bounce, kListMisses))
        return;
    uint path = params.numbers.data[i];
    PathState state = loadState(params.states, path);
    params.radiance.data[state.slot] += lightOfMiss(state, loadRay(params.rays, path));
}
