#version 460
// SPDX-License-Identifier: MIT
// Moves the faces that rays have hit lately into another table. Those that were listed are so again with kRelists.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceEvictParams, RADIANCE_EVICT_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/dispatch.glsl"

#define STATES_BINDING 1
#include "radiance/cached_face.glsl"
#include "radiance/list_faces.glsl"

void main()
{
    uint i = threadIndex();
    bool exists = i < params.old_slots;
    i = min(i, params.old_slots - 1u);
    CachedFace face = params.old_faces.data[i];
    FaceState state = params.old_states.data[i];
    exists = exists && face.key.x != 0u;
    uint level = levelOfFace(face.key);
    uint slot = kInPlace && exists ? i : kNoFace;
    bool claimed;
    // What is listed was hit since its mark has had a frame.
    bool stays = (state.mark & kFaceListed) != 0u || ((params.frame - state.mark) & kMarkFrames) <= params.age_max;
    if (!kInPlace && exists && stays)
        slot = placeFace(cellOfFace(face.key), normalOfFace(face.key), level, claimed);
    if (exists && slot == kNoFace)
        countFaces(level, ~0u);

    bool is_listed = kRelists && slot != kNoFace && level == 0u && (state.mark & kFaceListed) != 0u;
    uint element = appendTo(wantedList(params.frame), kListPaths, is_listed);
    if (is_listed)
        params.wanted.data[element] = slot;
    if (slot != kNoFace)
    {
        uint mark = is_listed ? state.mark : state.mark & ~(kFaceListed | kFaceSeen);
        params.faces.data[slot].light = face.light;
        params.states.data[slot] = FaceState(mark, state.recent, state.own);
    }
}
