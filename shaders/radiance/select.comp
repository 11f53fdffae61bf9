#version 460
// SPDX-License-Identifier: MIT
// Takes faces off the frame's list, and lists those that the frame samples.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceSelectParams, GPU_NO_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define FACES_BINDING 0
#define STATES_BINDING 1
#include "path/lists.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/rank.glsl"

void main()
{
    uint i = threadIndex();
    uint length = listLength(kWantedEven + (params.frame & 1u), kListPaths);
    uint slot = params.wanted.data[min(i, length - 1u)];
    uint mark = loadFaceState(slot).mark;
    uint rank = rankOfFace(loadFace(slot), mark, params.frame);
    bool is_taken = i < length && rank < params.counters.data[0].rank_limit;
    uint path = appendTo(0u, kListPaths, is_taken);
    if (is_taken)
        params.numbers.data[path] = slot;
    if (i < length)
        params.states.data[slot].mark =
            (mark & ((kMarkMovedFrames << kMarkMovedShift) | kFaceMoved)) | (params.frame & kMarkFrames);
}
