// SPDX-License-Identifier: MIT
// Lists faces that rays have hit, once. The includer includes radiance/insert_face.glsl and path/lists.glsl before;
// params has states and wanted, too.
#ifndef ZVO_SHADERS_RADIANCE_WANT_FACE_GLSL
#define ZVO_SHADERS_RADIANCE_WANT_FACE_GLSL

#include "path/lists.glsl"
#include "radiance/face_key.glsl"
#include "radiance/face_table.glsl"
#include "radiance/radiance.h"

// Adds a face to a list, kWantedEven or kWantedOdd, unless it is listed. bits: kFaceSeen or 0. All threads of a
// subgroup call this together.
void wantFace(uint slot, uint bits, uint list)
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
        params.wanted.data[element] = slot;
}

// The list of the faces that a frame takes.
uint wantedList(uint frame)
{
    return kWantedEven + (frame & 1u);
}

#endif
