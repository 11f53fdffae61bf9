// SPDX-License-Identifier: MIT
// Light between the faces of a plane. The includer includes lib/hit.glsl, radiance/face_table.glsl
// and radiance/kept_light.glsl before.

// The light at a place on a face, from those four faces with the same normal in the same plane whose middles are around
// it, as far as they keep any; then w is more than 0, and xyz are to be divided by it. Likewise between bricks. cell:
// of the level. place: from the cell's lower corner, in cells of the level. slot, here: the face that the place is on,
// as findFace() gives it.
vec4 lightBetweenFaces(uvec3 cell, uint normal, vec3 place, uint level, out uint slot, out KeptFace here)
{
    uint axis = normal % 3u;
    vec3 offset = clamp(place, 0.0, 1.0) - 0.5;
    vec2 across = axis == 0u ? offset.yz : axis == 1u ? offset.xz : offset.xy;
    ivec2 side = ivec2(across.x < 0.0 ? -1 : 1, across.y < 0.0 ? -1 : 1);
    across = abs(across);
    vec4 sum = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < 4u; ++k)
    {
        bvec2 far = bvec2((k & 1u) != 0u, (k & 2u) != 0u);
        ivec2 shift = ivec2(far.x ? side.x : 0, far.y ? side.y : 0);
        ivec3 moved = axis == 0u ? ivec3(0, shift) : axis == 1u ? ivec3(shift.x, 0, shift.y) : ivec3(shift, 0);
        KeptFace face;
        uint found_slot = findFace(uvec3(ivec3(cell) + moved) & kHitCoordinateMask, normal, level, face);
        bool found = found_slot != kNoFace;
        if (k == 0u)
        {
            slot = found_slot;
            here = face;
        }
        float share = (far.x ? across.x : 1.0 - across.x) * (far.y ? across.y : 1.0 - across.y);
        share = found && keptWeight(face.light) != 0u ? share : 0.0;
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
