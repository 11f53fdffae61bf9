#version 460
// SPDX-License-Identifier: MIT
// Copies the faces that rays have hit lately into another table. What was listed is not.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceEvictParams, GPU_NO_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/dispatch.glsl"
#include "radiance/face_table.glsl"
#include "radiance/insert_face.glsl"
#include "radiance/cached_face.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= kFaceRun * params.run_count)
        return;
    CachedFace face = params.old_faces.data[i];
    FaceState state = params.old_states.data[i];
    uint age = (params.frame - state.mark) & kMarkFrames;
    if (face.key.x == 0u || age > params.age_max)
        return;
    uint slot = insertFace(cellOfFace(face.key), normalOfFace(face.key), levelOfFace(face.key));
    if (slot != kNoFace)
    {
        params.faces.data[slot].light = face.light;
        params.states.data[slot] = FaceState(state.mark & ~(kFaceListed | kFaceSeen), state.recent, state.own);
    }
}
