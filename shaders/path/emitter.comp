#version 460
// SPDX-License-Identifier: MIT
// Adds the light of emissive voxels that rays have hit.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathLightParams, PATH_EMITTER_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "path/state.glsl"
#include "path/lists.glsl"
#include "path/voxel_light.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= listLength(params.bounce, kListEmitters))
        return;
    uint path = params.numbers.data[i];
    PathState state = loadState(params.states, path);
    params.radiance.data[state.slot] += lightOfHit(state, loadRay(params.rays, path), loadHit(params.hits, path));
}
