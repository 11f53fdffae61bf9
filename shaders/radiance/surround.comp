#version 460
// SPDX-License-Identifier: MIT
// Lists the bricks of a level around the faces that the frame samples, or around the listed bricks of the level before.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceSurroundParams, GPU_NO_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/dispatch.glsl"

#define STATES_BINDING 1
#include "path/lists.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/list_faces.glsl"

void main()
{
    uint i = threadIndex();
    uint length = listLength(params.of, kListPaths);
    bool exists = i < length;
    uint slot = params.slots.data[min(i, length - 1u)] & (kFaceSlotsMax - 1u);
    uvec2 key = loadFace(slot).key;
    listBrick(params.bricks, cellOfFace(key), normalOfFace(key), params.level, exists);
}
