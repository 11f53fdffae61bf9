// SPDX-License-Identifier: MIT
// Faces of voxels: their normals, numbered as in LightBrick::exposed, points of them, and the plane in which faces with
// the same normal lie side by side.
#ifndef ZVO_SHADERS_LIB_FACE_GLSL
#define ZVO_SHADERS_LIB_FACE_GLSL

// The normal with a number.
vec3 normalAxis(uint normal)
{
    float side = normal < 3u ? 1.0 : -1.0;
    uint axis = normal % 3u;
    return vec3(axis == 0u ? side : 0.0, axis == 1u ? side : 0.0, axis == 2u ? side : 0.0);
}

// The normal of the face of a hit, towards where the ray came from. The ray must not have started in the voxel.
uint normalOfHit(uint face, vec3 direction)
{
    float along = face == 0u ? direction.x : face == 1u ? direction.y : direction.z;
    return face + (along < 0.0 ? 0u : 3u);
}

// A point of a face of a voxel with this edge, by two numbers in [0, 1).
vec3 pointOfFace(uvec3 cell, uint normal, float edge, vec2 u)
{
    vec3 across = normal % 3u == 0u ? vec3(0.0, u) : normal % 3u == 1u ? vec3(u.x, 0.0, u.y) : vec3(u, 0.0);
    return 1.0 + edge * (vec3(cell) + max(normalAxis(normal), 0.0) + across);
}

// A step to another face of the plane, along its two axes in the order x, y, z.
ivec3 stepInPlane(uint normal, ivec2 steps)
{
    uint axis = normal % 3u;
    return axis == 0u ? ivec3(0, steps) : axis == 1u ? ivec3(steps.x, 0, steps.y) : ivec3(steps, 0);
}

// One of the four faces of a plane between which the light at a place is interpolated.
struct NearFace
{
    ivec3 steps; // from the cell of the face that the place is on
    float share; // of the light at the place; those of the four add up to 1
};

// k: 0 to 3; 0 is the face that the place is on. offset: of the place, from the middle of the cell. towards: 1 for the
// other three on the side of the place, whose middles are around it; -1 for those away from it.
NearFace nearFace(uint k, uint normal, vec3 offset, int towards)
{
    uint axis = normal % 3u;
    vec2 across = axis == 0u ? offset.yz : axis == 1u ? offset.xz : offset.xy;
    ivec2 side = towards * ivec2(across.x < 0.0 ? -1 : 1, across.y < 0.0 ? -1 : 1);
    across = abs(across);
    bvec2 far = bvec2((k & 1u) != 0u, (k & 2u) != 0u);
    vec2 share = vec2(far.x ? across.x : 1.0 - across.x, far.y ? across.y : 1.0 - across.y);
    return NearFace(stepInPlane(normal, ivec2(far.x ? side.x : 0, far.y ? side.y : 0)), share.x * share.y);
}

#endif
