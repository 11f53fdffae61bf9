// SPDX-License-Identifier: MIT
// Light of the faces around one that keeps none. The includer includes lib/hit.glsl, radiance/face_table.glsl and
// radiance/kept_light.glsl before.
#include "radiance/plane.glsl"

// The mean light that the four faces with the same normal keep which share an edge with a face. No wall is between
// them: the voxel over each of them is empty. is_lit: whether any keeps light.
vec3 lightOfNeighbors(uvec3 cell, uint normal, out bool is_lit)
{
    vec4 sum = vec4(0.0);
    for (uint k = 0u; k < 4u; ++k)
    {
        int step = (k & 1u) != 0u ? 1 : -1;
        ivec3 steps = stepInPlane(normal, (k & 2u) != 0u ? ivec2(step, 0) : ivec2(0, step));
        KeptFace face;
        uint slot = findFace(uvec3(ivec3(cell) + steps) & kHitCoordinateMask, normal, 0u, face);
        if (slot != kNoFace && keptWeight(face.light) != 0u)
            sum += vec4(recentRadiance(loadFaceState(slot).recent), 1.0);
    }
    is_lit = sum.w != 0.0;
    return sum.rgb / max(sum.w, 1.0);
}
