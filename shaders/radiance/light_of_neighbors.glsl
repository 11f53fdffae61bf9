// SPDX-License-Identifier: MIT
// Light of the faces around one that keeps none. The includer includes radiance/face_table.glsl and
// radiance/kept_light.glsl before.

// The mean light that the four faces with the same normal keep which share an edge with a face. No wall is between
// them: the voxel over each of them is empty. is_lit: whether any keeps light.
vec3 lightOfNeighbors(uvec3 cell, uint normal, out bool is_lit)
{
    uint axis = normal % 3u;
    vec4 sum = vec4(0.0);
    for (uint k = 0u; k < 4u; ++k)
    {
        int step = (k & 1u) != 0u ? 1 : -1;
        ivec2 shift = (k & 2u) != 0u ? ivec2(step, 0) : ivec2(0, step);
        ivec3 moved = axis == 0u ? ivec3(0, shift) : axis == 1u ? ivec3(shift.x, 0, shift.y) : ivec3(shift, 0);
        KeptFace face;
        uint slot = findFace(uvec3(ivec3(cell) + moved) & kHitCoordinateMask, normal, 0u, face);
        if (slot != kNoFace && keptWeight(face.light) != 0u)
            sum += vec4(recentRadiance(loadFaceState(slot).recent), 1.0);
    }
    is_lit = sum.w != 0.0;
    return sum.rgb / max(sum.w, 1.0);
}
