// SPDX-License-Identifier: MIT
// Lists of faces that rays have hit, and of the bricks that get light in a frame: each stands in its list once.
// Needs params.faces, params.run_count, params.counters, params.states, params.lists and STATES_BINDING.
#ifndef ZVO_SHADERS_RADIANCE_LIST_FACES_GLSL
#define ZVO_SHADERS_RADIANCE_LIST_FACES_GLSL

#include "path/lists.glsl"
#include "radiance/face_table.glsl"
#include "radiance/insert_face.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/radiance.h"

// Puts a brick into the table and into the list of its level, unless it is there. cell: in the brick, of the level
// below. All threads of a subgroup call this together.
void listBrick(uint_Ptr bricks, uvec3 cell, uint normal, uint level, bool exists)
{
    uint slot = kNoFace;
    if (exists)
        slot = insertFace(cell >> 2, normal, level);
    bool is_new = false;
    if (slot != kNoFace)
        is_new = (atomicOr(params.states.data[slot].mark, kFaceListed) & kFaceListed) == 0u;
    uint i = appendTo(kFirstBricks + level - 1u, kListPaths, is_new);
    if (is_new)
    {
        bricks.data[i] = slot;
        params.states.data[slot].recent = i; // where the sum is
    }
}

// Adds a face that a ray has hit to a list, kWantedEven or kWantedOdd, unless it is listed. wanted: the list. bits:
// kFaceSeen or 0. All threads of a subgroup call this together.
void wantFace(uint_Ptr wanted, uint slot, uint bits, uint list)
{
    bool is_new = false;
    if (slot != kNoFace)
    {
        uint wanted_bits = kFaceListed | bits;
        // Most faces are listed, and an atomic costs more than a load.
        if ((loadFaceState(slot).mark & wanted_bits) != wanted_bits)
            is_new = (atomicOr(params.states.data[slot].mark, wanted_bits) & kFaceListed) == 0u;
    }
    uint element = appendTo(list, kListPaths, is_new);
    if (is_new)
        wanted.data[element] = slot;
}

// The list of the faces that a frame takes.
uint wantedList(uint frame)
{
    return kWantedEven + (frame & 1u);
}

#endif
