// SPDX-License-Identifier: MIT
// Light between the faces of a plane. The includer includes lib/hit.glsl, radiance/face_table.glsl,
// radiance/kept_light.glsl and radiance/plane.glsl before.
#ifndef ZVO_SHADERS_RADIANCE_BETWEEN_FACES_GLSL
#define ZVO_SHADERS_RADIANCE_BETWEEN_FACES_GLSL

#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "radiance/face_table.glsl"
#include "radiance/kept_faces.h"
#include "radiance/kept_light.glsl"

// The light at a place on a face, from those four faces with the same normal in the same plane whose middles are around
// it, as far as they keep any; then w is more than 0, and xyz are to be divided by it. Likewise between bricks. cell:
// of the level. place: from the cell's lower corner, in cells of the level. slot, here: the face that the place is on,
// as findFace() gives it.
vec4 lightBetweenFaces(uvec3 cell, uint normal, vec3 place, uint level, out uint slot, out KeptFace here)
{
    vec3 offset = clamp(place, 0.0, 1.0) - 0.5;
    vec4 sum = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < 4u; ++k)
    {
        NearFace near = nearFace(k, normal, offset, 1);
        KeptFace face;
        uint found_slot = findFace(uvec3(ivec3(cell) + near.steps) & kHitCoordinateMask, normal, level, face);
        bool found = found_slot != kNoFace;
        if (k == 0u)
        {
            slot = found_slot;
            here = face;
        }
        float share = found && keptWeight(face.light) != 0u ? near.share : 0.0;
        sum += share * vec4(keptRadiance(face.light), 1.0);
    }
    return sum;
}

// As above, without the face itself.
vec4 lightBetweenFaces(uvec3 cell, uint normal, vec3 place, uint level)
{
    uint slot;
    KeptFace here;
    return lightBetweenFaces(cell, normal, place, level, slot, here);
}

#endif
