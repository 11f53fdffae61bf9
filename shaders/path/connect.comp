#version 460
// SPDX-License-Identifier: MIT
// Adds the light of the shadow rays that reach their lights.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "path/state.glsl"

layout(constant_id = 0) const bool kNotes = false;

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathConnectParams params;
};

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
