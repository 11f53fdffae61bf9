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

// The first slot to look at. The faces of 2x2x2 cells of a level stand side by side.
uint faceHome(uvec3 cell, uint normal, uint level)
{
    uvec3 pair = cell >> 1;
    uint mixed = pair.x * 0x9E3779B1u ^ pair.y * 0x85EBCA77u ^ pair.z * 0xC2B2AE3Du ^
                 (normal | (level << 3)) * 0x27D4EB2Fu;
    mixed = (mixed ^ (mixed >> 15)) * 0x2C1B3C6Du;
    mixed ^= mixed >> 13;
    uint run;
    uint rest;
    umulExtended(mixed, params.run_count, run, rest);
    return kFaceRun * run + ((cell.x & 1u) | ((cell.y & 1u) << 1) | ((cell.z & 1u) << 2));
}

uint slotAfter(uint slot)
{
    return slot + 1u == kFaceRun * params.run_count ? 0u : slot + 1u;
}

// The slot of a face, or of a brick, that an earlier dispatch inserted, or kNoFace. face: its contents.
uint findFace(uvec3 cell, uint normal, uint level, out CachedFace face)
{
    uvec2 key = faceKey(cell, normal, level);
    uint slot = faceHome(cell, normal, level);
    face = loadFace(slot);
    for (uint probe = 0u; face.key != key && face.key.x != 0u && probe < kFaceProbesMax; ++probe)
    {
        slot = slotAfter(slot);
        face = loadFace(slot);
    }
    return face.key == key ? slot : kNoFace;
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
