// SPDX-License-Identifier: MIT
// Light of bricks, where no face keeps any. The includer includes radiance/face_table.glsl and radiance/kept_light.glsl
// before.
#ifndef ZVO_SHADERS_RADIANCE_LIGHT_OF_BRICK_GLSL
#define ZVO_SHADERS_RADIANCE_LIGHT_OF_BRICK_GLSL

#include "radiance/face_table.glsl"
#include "radiance/kept_faces.h"
#include "radiance/kept_light.glsl"

// The light of the faces with a normal in the least brick around a voxel's cell that keeps some. w: 1; 0 where none
// does, or where none is asked for.
vec4 lightOfBrick(uvec3 cell, uint normal, bool is_asked)
{
    vec4 light = vec4(0.0);
    for (uint level = 1u; is_asked && level <= kBrickLevels; ++level)
    {
        KeptFace face;
        is_asked = findFace(cell >> (2u * level), normal, level, face) == kNoFace || keptWeight(face.light) == 0u;
        light = is_asked ? light : vec4(keptRadiance(face.light), 1.0);
    }
    return light;
}

#endif
