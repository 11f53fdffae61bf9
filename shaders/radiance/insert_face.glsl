// SPDX-License-Identifier: MIT
// Inserts faces into the table.
// Needs params.faces, params.run_count and params.counters.
#ifndef ZVO_SHADERS_RADIANCE_INSERT_FACE_GLSL
#define ZVO_SHADERS_RADIANCE_INSERT_FACE_GLSL

#include "radiance/face_table.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/cached_faces.h"

#define FACE_WORD(SLOT, WORD) uint_Ptr(uint64_t(params.faces) + uint64_t(SLOT) * kCachedFaceBytes).data[WORD]

// Adds to the count of faces, or of bricks.
void countFaces(uint level, uint more)
{
    if (level == 0u)
        atomicAdd(params.counters.data[0].face_count, more);
    else
        atomicAdd(params.counters.data[0].brick_count, more);
}

// The slot of a face, or of a brick, which is taken if it has none; kNoFace if there is no place. claimed: whether this
// thread has taken it. Of both words of a key, which are set one after the other, each is written at most once:
// lib/bricks.glsl says why that suffices.
uint placeFace(uvec3 cell, uint normal, uint level, out bool claimed)
{
    uvec2 key = faceKey(cell, normal, level);
    uint slot = faceHome(cell, normal, level);
    bool searching = true;
    claimed = false;
    for (uint probe = 0u; searching && probe < kFaceProbesMax; ++probe)
    {
        uvec2 found = loadFace(slot).key;
        if (found.x == 0u)
        {
            found.x = atomicCompSwap(FACE_WORD(slot, 0u), 0u, key.x);
            found.x = found.x == 0u ? key.x : found.x;
        }
        if (found.x == key.x && found.y == 0u)
        {
            found.y = atomicCompSwap(FACE_WORD(slot, 1u), 0u, key.y);
            claimed = found.y == 0u;
            found.y = claimed ? key.y : found.y;
        }
        searching = found != key;
        slot = searching ? slotAfter(slot) : slot;
    }
    return searching ? kNoFace : slot;
}

// placeFace(), and counts the face, or that it was refused.
uint insertFace(uvec3 cell, uint normal, uint level)
{
    bool claimed;
    uint slot = placeFace(cell, normal, level, claimed);
    if (claimed)
        countFaces(level, 1u);
    if (slot == kNoFace && level == 0u)
        atomicAdd(params.counters.data[0].refused, 1u);
    return slot;
}

#endif
