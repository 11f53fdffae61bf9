#version 460
// SPDX-License-Identifier: MIT
// Adds the light that the faces reflect which paths have hit, and wants these faces in the next frame. Paths that have
// met other light are listed.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"
#include "lib/attribute_formats.glsl"
#include "lib/bound.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/ray_words.glsl"
#include "lib/surface_normal.glsl"
#include "path/face.glsl"

layout(constant_id = 0) const uint kFormat = kFormat8; // of attributes
layout(constant_id = 1) const bool kEmission = false;  // there are emissive voxels

layout(local_size_x = kRadianceGroup) in;
layout(push_constant, scalar) uniform Push
{
    RadianceGatherParams params;
};

#define FACES_BINDING 0
#define HITS_BINDING 2
#define STATES_BINDING 1
const uint kNodeLevels = 0u; // no hit is a node's
#include "trace/surface.glsl"
#include "path/hit_voxel.glsl"
#include "path/lists.glsl"
#include "radiance/face_key.glsl"
#include "radiance/face_table.glsl"
#include "radiance/hit_loads.glsl"
#include "radiance/kept_light.glsl"
#include "radiance/insert_face.glsl"
#include "radiance/want_face.glsl"

void main()
{
    uint i = threadIndex();
    uint count = listLength(0u, kListPaths);
    bool exists = i < count;
    i = min(i, count - 1u);
    Hit hit = hitAt(i);
    bool hits = exists && !isMiss(hit);

    uint miss = appendTo(0u, kListMisses, exists && !hits);
    if (exists && !hits)
        params.numbers.data[kListMisses * params.batch + miss] = i;
    if (kEmission)
    {
        bool emits = hits && isEmitter(hits ? hit.index : 0u);
        uint emitter = appendTo(0u, kListEmitters, emits);
        if (emits)
            params.numbers.data[kListEmitters * params.batch + emitter] = i;
    }

    if (hits && hit.index >= params.first_moving)
        params.numbers.data[i] |= kPathTouched; // of kListPaths, the first list

    uint slot = kNoFace;
    if (hits && hitFace(hit) != kFaceInside)
    {
        uint normal = normalOfHit(hitFace(hit), loadRay(params.rays, i).inverse_direction);
        slot = insertFace(hitCell(hit), normal, 0u);
        if (slot != kNoFace)
        {
            FaceState state = loadFaceState(slot);
            params.radiance.data[i] = albedoOf(attributeAt(true, hit)) * recentRadiance(state.recent);
        }
    }
    wantFace(slot, 0u, wantedList(params.frame + 1u));
}
