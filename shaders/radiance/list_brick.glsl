// SPDX-License-Identifier: MIT
// Lists the bricks that get light in a frame. The includer includes radiance/insert_face.glsl and path/lists.glsl
// before; params has states, bricks and batch, too.
#ifndef ZVO_SHADERS_RADIANCE_LIST_BRICK_GLSL
#define ZVO_SHADERS_RADIANCE_LIST_BRICK_GLSL

#include "path/lists.glsl"
#include "radiance/face_table.glsl"
#include "radiance/insert_face.glsl"
#include "radiance/radiance.h"

// Puts a brick into the table and into the list of its level, unless it is there. cell: in it, of the level below. All
// threads of a subgroup call this together.
void listBrick(uvec3 cell, uint normal, uint level, bool exists)
{
    uint slot = kNoFace;
    if (exists)
        slot = insertFace(cell >> 2, normal, level);
    bool is_new = false;
    if (slot != kNoFace)
        is_new = (atomicOr(params.states.data[slot].mark, kFaceListed) & kFaceListed) == 0u;
    uint element = (level - 1u) * params.batch + appendTo(kFirstBricks + level - 1u, kListPaths, is_new);
    if (is_new)
    {
        params.bricks.data[element] = slot;
        params.states.data[slot].recent = element;
    }
}

#endif
