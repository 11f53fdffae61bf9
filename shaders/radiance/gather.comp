#version 460
// SPDX-License-Identifier: MIT
// Adds the light that the faces reflect which paths have hit, and wants these faces in the next frame. Paths that have
// met other light are listed, and those that have hit a face without light. Of those, the second rays of paths take the
// light of the faces beside it, or none.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceGatherParams, RADIANCE_GATHER_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/ray.glsl"
#include "path/state.glsl"

const uint kNodeLevels = 0u; // no hit is a node's
#define FACES_BINDING 0
#define HITS_BINDING 2
#define STATES_BINDING 1
#include "radiance/face_table.glsl"
#include "radiance/hits.glsl"
#include "radiance/insert_face.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/list_faces.glsl"
#include "trace/surface.glsl"

void main()
{
    uint i = threadIndex();
    uint ray = kEnds ? 1u : 0u;
    uint count = listLength(ray, kListPaths);
    bool exists = i < count;
    i = min(i, count - 1u);
    Hit hit = hitAt(i);
    bool hits = exists && !isMiss(hit);

    uint miss = appendTo(ray, kListMisses, exists && !hits);
    if (exists && !hits)
        params.numbers.data[kListMapLights * params.batch + miss] = i; // whose numbers are not needed any more
    if (kEmission)
    {
        bool emits = hits && isEmissive(params.emission_words, hits ? hit.index : 0u);
        uint emitter = appendTo(ray, kListEmitters, emits);
        if (emits)
            params.numbers.data[kListVoxelLights * params.batch + emitter] = i;
    }

    if (!kEnds && hits && hit.index >= params.first_moving)
        params.numbers.data[i] |= kPathTouched; // of kListPaths, the first list

    uint slot = kNoFace;
    bool is_lit = true;
    if (hits && hitFace(hit) != kFaceInside)
    {
        uint normal = normalOfHit(hitFace(hit), loadRay(params.rays, i).inverse_direction);
        slot = insertFace(hitCell(hit), normal, 0u);
        uint recent = 0u;
        if (slot != kNoFace)
            recent = loadFaceState(slot).recent;
        is_lit = recent != 0u || (slot != kNoFace && cachedWeight(loadFace(slot).light) != 0u);
        vec3 light = recentRadiance(recent);
        if (kEnds && !is_lit)
            light = lightOfNeighbors(hitCell(hit), normal, is_lit);
        if (is_lit)
        {
            PathState state = PathState(vec3(1.0), i, 0u, 0u, 0.0, vec3(0.0));
            if (kEnds)
                state = loadState(params.path_states, i);
            vec3 albedo = albedoOf(attributeAt(true, hit, params.attributes));
            params.radiance.data[state.slot] += state.throughput * albedo * light;
        }
    }
    wantFace(params.wanted, slot, 0u, wantedList(params.frame + 1u));
    if (!kEnds)
    {
        uint unlit = appendTo(kUnlitPaths, kListPaths, !is_lit);
        if (!is_lit)
            params.numbers.data[kListShadows * params.batch + unlit] = i;
    }
}
