// SPDX-License-Identifier: MIT
// The table of faces (radiance.h). The includer includes radiance/face_key.glsl before; params has run_count, too.
#ifndef ZVO_SHADERS_RADIANCE_FACE_TABLE_GLSL
#define ZVO_SHADERS_RADIANCE_FACE_TABLE_GLSL

#include "radiance/face_key.glsl"
#include "radiance/kept_faces.h"

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
uint findFace(uvec3 cell, uint normal, uint level, out KeptFace face)
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

#endif
