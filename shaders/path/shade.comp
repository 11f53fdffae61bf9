#version 460
// SPDX-License-Identifier: MIT
// Takes each path of a list on by one bounce: where its ray has hit a voxel, the next ray starts. What has to be done
// for some paths alone is listed.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathShadeParams, PATH_SHADE_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "path/state.glsl"
#include "path/lists.glsl"
#include "path/next_ray.glsl"
#include "trace/surface.glsl"

void main()
{
    uint i = threadIndex();
    uint count = listLength(params.bounce, kListPaths);
    bool exists = i < count;
    i = min(i, count - 1u);
    PathState state = loadState(params.states, i);
    Ray ray = loadRay(params.rays, i);
    Hit hit = loadHit(params.hits, i);
    bool hits = exists && !isMiss(hit);
    Attribute stored = attributeAt(hits, hit, params.attributes);

    uint miss = appendTo(params.bounce, kListMisses, exists && !hits);
    if (exists && !hits)
        params.numbers.data[kListMisses * params.batch + miss] = i;
    if (kEmission)
    {
        bool emits = hits && isEmissive(params.emission_words, hits ? hit.index : 0u);
        uint emitter = appendTo(params.bounce, kListEmitters, emits);
        if (emits)
            params.numbers.data[kListEmitters * params.batch + emitter] = i;
    }
    if (kLast)
        return;

    NextRay next =
        nextRay(state, ray, hits, hit, albedoOf(stored), stored.normal, kRoulette, params.bounce);
    uint next_path = appendTo(params.bounce + 1u, kListPaths, next.exists);
    if (next.exists)
    {
        storeRay(params.next_rays, next_path, next.ray);
        storeState(params.next_states, next_path, next.state);
    }

    // A light to look for.
    if (kSampling == kSampleChance)
        return;
    listChosen(params.numbers, params.batch, next, next_path, params.bounce);
}
