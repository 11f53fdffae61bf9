// SPDX-License-Identifier: MIT
// The table of faces (radiance/cached_faces.h): finding them, and the light that they keep around a place.
// Needs params.faces and params.run_count, and params.states with STATES_BINDING.
#ifndef ZVO_SHADERS_RADIANCE_FACE_TABLE_GLSL
#define ZVO_SHADERS_RADIANCE_FACE_TABLE_GLSL

#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/cached_faces.h"

const uint kNoFace = ~0u;

// Where a face, or a brick, may be: in a first slot (x), then in slots that are a step (y) apart. The faces of 2x2x2
// cells of a level have their first ones side by side, and the same step.
uvec2 placesOfFace(uvec3 cell, uint normal, uint level)
{
    uvec3 pair = cell >> 1;
    uint mixed = pair.x * 0x9E3779B1u ^ pair.y * 0x85EBCA77u ^ pair.z * 0xC2B2AE3Du ^
                 (normal | (level << 3)) * 0x27D4EB2Fu;
    mixed = (mixed ^ (mixed >> 15)) * 0x2C1B3C6Du;
    mixed ^= mixed >> 13;
    uint run;
    uint rest;
    umulExtended(mixed, params.run_count, run, rest);
    uint slot = kFaceRun * run + ((cell.x & 1u) | ((cell.y & 1u) << 1) | ((cell.z & 1u) << 2));
    return uvec2(slot, (rest >> 25) | 1u); // less than kFaceRun * kFaceRunsMin
}

uint placeAfter(uvec2 places)
{
    uint slot = places.x + places.y;
    uint end = kFaceRun * params.run_count;
    return slot < end ? slot : slot - end;
}

// How many places after the first one are to be looked at, as a number of 4 bits, rounded up: in the key of a first
// slot, for all faces that have it, so that most lookups of faces that are not there end in it.
uint reachFor(uint places)
{
    return places <= 8u ? places : uint(findMSB(places - 1u)) + 6u;
}

uint placesWithin(uint reach)
{
    return reach <= 8u ? reach : 1u << (reach - 5u);
}

bool hasKey(CachedFace face, uvec2 key)
{
    return uvec2(bitfieldExtract(face.key.x, 0, int(kFaceReachShift)), face.key.y) == key;
}

// The slot of a face, or of a brick, that an earlier dispatch inserted, or kNoFace. face: its contents.
uint findFace(uvec3 cell, uint normal, uint level, out CachedFace face)
{
    uvec2 key = faceKey(cell, normal, level);
    uvec2 places = placesOfFace(cell, normal, level);
    face = loadFace(places.x);
    uint others = placesWithin(face.key.x >> kFaceReachShift);
    for (uint place = 0u; !hasKey(face, key) && place < others; ++place)
    {
        places.x = placeAfter(places);
        face = loadFace(places.x);
    }
    return hasKey(face, key) ? places.x : kNoFace;
}

// The light of the faces with a normal in the least brick around a voxel's cell that keeps some. w: 1; 0 where none
// does, or where none is asked for.
vec4 lightOfBrick(uvec3 cell, uint normal, bool is_asked)
{
    vec4 light = vec4(0.0);
    for (uint level = 1u; is_asked && level <= kBrickLevels; ++level)
    {
        CachedFace face;
        is_asked = findFace(cell >> (2u * level), normal, level, face) == kNoFace || cachedWeight(face.light) == 0u;
        light = is_asked ? light : vec4(cachedRadiance(face.light), 1.0);
    }
    return light;
}

// The light at a place on a face, from those four faces with the same normal in the same plane whose middles are around
// it, as far as they keep any; then w is more than 0, and xyz are to be divided by it. Bricks are mixed as faces are.
// cell: of the level. place: from the cell's lower corner, in cells of the level. slot, here: the face that the place
// is on, as findFace() gives it.
vec4 lightBetweenFaces(uvec3 cell, uint normal, vec3 place, uint level, out uint slot, out CachedFace here)
{
    vec3 offset = clamp(place, 0.0, 1.0) - 0.5;
    vec4 sum = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < 4u; ++k)
    {
        NearFace near = nearFace(k, normal, offset, 1);
        CachedFace face;
        uint found_slot = findFace(uvec3(ivec3(cell) + near.steps) & kHitCoordinateMask, normal, level, face);
        bool found = found_slot != kNoFace;
        if (k == 0u)
        {
            slot = found_slot;
            here = face;
        }
        float share = found && cachedWeight(face.light) != 0u ? near.share : 0.0;
        sum += share * vec4(cachedRadiance(face.light), 1.0);
    }
    return sum;
}

// The light between four faces or bricks alone.
vec4 lightBetweenFaces(uvec3 cell, uint normal, vec3 place, uint level)
{
    uint slot;
    CachedFace here;
    return lightBetweenFaces(cell, normal, place, level, slot, here);
}

#ifdef STATES_BINDING
// The mean light of the faces that touch a face in its plane, up to four, as far as they keep any. Their light was not
// behind a wall, since the voxel over each was empty when it arrived. is_lit: whether any has cached light.
vec3 lightOfNeighbors(uvec3 cell, uint normal, out bool is_lit)
{
    vec4 sum = vec4(0.0);
    for (uint k = 0u; k < 4u; ++k)
    {
        int side = (k & 1u) != 0u ? 1 : -1;
        ivec3 steps = stepInPlane(normal, (k & 2u) != 0u ? ivec2(side, 0) : ivec2(0, side));
        CachedFace face;
        uint slot = findFace(uvec3(ivec3(cell) + steps) & kHitCoordinateMask, normal, 0u, face);
        if (slot != kNoFace && cachedWeight(face.light) != 0u)
            sum += vec4(recentRadiance(loadFaceState(slot).recent), 1.0);
    }
    is_lit = sum.w != 0.0;
    return sum.rgb / max(sum.w, 1.0);
}
#endif

#endif
