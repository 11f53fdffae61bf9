// SPDX-License-Identifier: MIT
// Faces of voxels. Their normals are numbered as in LightBrick::exposed.
#ifndef ZVO_SHADERS_PATH_FACE_GLSL
#define ZVO_SHADERS_PATH_FACE_GLSL

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

#endif
