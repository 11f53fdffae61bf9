#version 460
// SPDX-License-Identifier: MIT
// Adds the light from outside of the grid that rays have met.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "lib/ray.glsl"
#include "path/state.glsl"

layout(constant_id = 0) const uint kSampling = kSampleBoth; // how light is found

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathLightParams params;
};

#include "path/lists.glsl"
#include "path/map_light.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= listLength(params.bounce, kListMisses))
        return;
    uint path = params.numbers.data[kListMisses * params.batch + i];
    PathState state = loadState(params.states, path);
    params.radiance.data[state.slot] += lightOfMiss(state, loadRay(params.rays, path));
}
