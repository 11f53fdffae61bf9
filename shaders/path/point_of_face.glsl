// SPDX-License-Identifier: MIT
// Random points of faces. The includer includes path/face.glsl before.
#ifndef ZVO_SHADERS_PATH_POINT_OF_FACE_GLSL
#define ZVO_SHADERS_PATH_POINT_OF_FACE_GLSL

#include "path/face.glsl"

// A point of a face of a voxel with this edge, by two numbers in [0, 1).
vec3 pointOfFace(uvec3 cell, uint normal, float edge, vec2 u)
{
    vec3 across = normal % 3u == 0u ? vec3(0.0, u) : normal % 3u == 1u ? vec3(u.x, 0.0, u.y) : vec3(u, 0.0);
    return 1.0 + edge * (vec3(cell) + max(normalAxis(normal), 0.0) + across);
}

#endif
