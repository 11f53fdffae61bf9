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
// thread has taken it. Of both words of a key, which are set one after the other, each is written at most once, but for
// the reach: lib/bricks.glsl says why that suffices. The reach is for later dispatches.
uint placeFace(uvec3 cell, uint normal, uint level, out bool claimed)
{
    uvec2 key = faceKey(cell, normal, level);
    uvec2 places = placesOfFace(cell, normal, level);
    uint first = places.x;
    uint first_word = key.x;
    bool searching = true;
    claimed = false;
    uint place = 0u;
    for (; searching && place < kFaceProbesMax; ++place)
    {
        uvec2 found = loadFace(places.x).key;
        if (found.x == 0u)
        {
            found.x = atomicCompSwap(FACE_WORD(places.x, 0u), 0u, key.x);
            found.x = found.x == 0u ? key.x : found.x;
        }
        found.x = bitfieldExtract(found.x, 0, int(kFaceReachShift));
        if (found.x == key.x && found.y == 0u)
        {
            found.y = atomicCompSwap(FACE_WORD(places.x, 1u), 0u, key.y);
            claimed = found.y == 0u;
            found.y = claimed ? key.y : found.y;
        }
        searching = found != key;
        first_word = place == 0u ? found.x : first_word;
        places.x = searching ? placeAfter(places) : places.x;
    }
    if (claimed && place > 1u)
        atomicMax(FACE_WORD(first, 0u), first_word | (reachFor(place - 1u) << kFaceReachShift));
    return searching ? kNoFace : places.x;
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
