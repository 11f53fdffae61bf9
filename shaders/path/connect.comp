#version 460
// SPDX-License-Identifier: MIT
// Adds the light of the shadow rays that reach their lights.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathConnectParams, PATH_CONNECT_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "path/state.glsl"
#include "path/lists.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= listLength(params.bounce, kListShadows))
        return;
    ShadowState state = params.shadow_states.data[i];
    Hit hit = loadHit(params.hits, i);
    if (reachesLight(hit, state.target))
        params.radiance.data[state.slot] += state.light;
    if (kNotes && !isMiss(hit) && hit.index >= params.first_noted)
        params.numbers.data[state.slot] |= 1u << 31;
}
