// SPDX-License-Identifier: MIT
// Kept faces and their keys (radiance.h). The includer includes radiance/radiance.h and lib/bound.glsl before, declares
// params.faces, and defines
//   FACES_BINDING     optional: the binding for params.faces
//   STATES_BINDING    where params has states: the binding for them
#ifndef ZVO_SHADERS_RADIANCE_FACE_KEY_GLSL
#define ZVO_SHADERS_RADIANCE_FACE_KEY_GLSL

#include "lib/bound.glsl"
#include "radiance/kept_faces.h"

// cell: of the level. normal: its number as in LightBrick::exposed.
uvec2 faceKey(uvec3 cell, uint normal, uint level)
{
    return uvec2(cell.x | (cell.y << 18), (cell.y >> 13) | (cell.z << 5) | (normal << 23) | (level << 26)) |
           kFaceKeyTag;
}

uvec3 cellOfFace(uvec2 key)
{
    return uvec3(key.x & 0x3FFFFu, bitfieldExtract(key.x, 18, 13) | ((key.y & 31u) << 13),
                 bitfieldExtract(key.y, 5, 18));
}

uint normalOfFace(uvec2 key)
{
    return bitfieldExtract(key.y, 23, 3);
}

uint levelOfFace(uvec2 key)
{
    return bitfieldExtract(key.y, 26, 5);
}

// Bound forms (lib/bound.glsl) read both from texels.
#if defined(BOUND) && defined(FACES_BINDING)

TEXELS_4(FACES_BINDING, faces);

KeptFace loadFace(uint slot)
{
    uvec4 words = texelFetch(texels4_faces, int(slot));
    return KeptFace(words.xy, words.zw);
}

#else

KeptFace loadFace(uint slot)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(params.faces));
    return KeptFace(unpackUint2x32(words.data[2u * slot]), unpackUint2x32(words.data[2u * slot + 1u]));
}

#endif

#ifdef STATES_BINDING
#include "radiance/radiance.h"

#ifdef BOUND
TEXELS_4(STATES_BINDING, states);

FaceState loadFaceState(uint slot)
{
    uvec4 words = texelFetch(texels4_states, int(slot));
    return FaceState(words.x, words.y, words.zw);
}
#else
FaceState loadFaceState(uint slot)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(params.states));
    uvec2 first = unpackUint2x32(words.data[2u * slot]);
    return FaceState(first.x, first.y, unpackUint2x32(words.data[2u * slot + 1u]));
}
#endif
#endif

#endif
