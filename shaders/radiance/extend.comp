#version 460
// SPDX-License-Identifier: MIT
// Takes paths that have hit a face without light: adds what the faces around it reflect, or goes on by one more ray.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceExtendParams, RADIANCE_EXTEND_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "path/state.glsl"

const bool kSmooth = false; // light goes from face to face

#define FACES_BINDING 0
#define STATES_BINDING 1
#include "path/lists.glsl"
#include "path/next_ray.glsl"
#include "radiance/face_table.glsl"
#include "trace/surface.glsl"

void main()
{
    uint unlit = threadIndex();
    uint count = listLength(kUnlitPaths, kListPaths);
    bool exists = unlit < count;
    uint i = params.numbers.data[kListShadows * params.batch + min(unlit, count - 1u)];
    PathState state = loadState(params.path_states, i);
    Ray ray = loadRay(params.rays, i);
    Hit hit = loadHit(params.hits, i);
    Attribute stored = attributeAt(exists, hit, params.attributes);
    bool is_lit;
    vec3 light = lightOfNeighbors(hitCell(hit), normalOfHit(hitFace(hit), ray.inverse_direction), is_lit);
    if (exists && is_lit)
        params.radiance.data[state.slot] += state.throughput * albedoOf(stored) * light;

    NextRay next = nextRay(state, ray, exists && !is_lit, hit, albedoOf(stored), kNoNormal, false, 1u);
    uint path = appendTo(1u, kListPaths, next.exists);
    if (next.exists)
    {
        storeRay(params.next_rays, path, next.ray);
        storeState(params.next_states, path, next.state);
    }
    listChosen(params.numbers, params.batch, next, path, 1u);
}
