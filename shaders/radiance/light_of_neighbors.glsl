// SPDX-License-Identifier: MIT
// Light of the faces beside one that keeps none. The includer includes lib/hit.glsl, radiance/face_table.glsl,
// radiance/kept_light.glsl and radiance/plane.glsl before; params has states, too, and STATES_BINDING is defined.
#ifndef ZVO_SHADERS_RADIANCE_LIGHT_OF_NEIGHBORS_GLSL
#define ZVO_SHADERS_RADIANCE_LIGHT_OF_NEIGHBORS_GLSL

#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "radiance/face_key.glsl"
#include "radiance/face_table.glsl"
#include "radiance/kept_faces.h"
#include "radiance/kept_light.glsl"

// The mean light of the faces that touch a face in its plane, up to four, as far as they keep any. Their light was not
// behind a wall, since the voxel over each was empty when it arrived. is_lit: whether any keeps light.
vec3 lightOfNeighbors(uvec3 cell, uint normal, out bool is_lit)
{
    vec4 sum = vec4(0.0);
    for (uint k = 0u; k < 4u; ++k)
    {
        int side = (k & 1u) != 0u ? 1 : -1;
        ivec3 steps = stepInPlane(normal, (k & 2u) != 0u ? ivec2(side, 0) : ivec2(0, side));
        KeptFace face;
        uint slot = findFace(uvec3(ivec3(cell) + steps) & kHitCoordinateMask, normal, 0u, face);
        if (slot != kNoFace && keptWeight(face.light) != 0u)
            sum += vec4(recentRadiance(loadFaceState(slot).recent), 1.0);
    }
    is_lit = sum.w != 0.0;
    return sum.rgb / max(sum.w, 1.0);
}

#endif
