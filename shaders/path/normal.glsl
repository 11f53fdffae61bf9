// SPDX-License-Identifier: MIT
// The normals of surfaces that paths leave (PathState::normal): numbers of faces, as in LightBrick::exposed, and with
// kSmooth codes of any normals, too. Light is then chosen by a mixture of what faces along the three axes would choose,
// by the squares of the normal's components: each direction above the surface is above one of them.
// Needs the constant kSmooth.
#ifndef ZVO_SHADERS_PATH_NORMAL_GLSL
#define ZVO_SHADERS_PATH_NORMAL_GLSL

#include "lib/face.glsl"
#include "lib/normal.glsl"
#include "light/outside.h"
#include "path/path.h"

bool isFaceNormal(uint normal)
{
    return !kSmooth || normal < kNormals;
}

// The normal (length 1) with a number or code.
vec3 normalOf(uint normal)
{
    return isFaceNormal(normal) ? normalAxis(normal) : normalize(vec3(decodeNormal(normal)));
}

// The few codes that are numbers of faces become one beside them, which is 0.01 degrees off.
uint codeOf(vec3 normal)
{
    return max(encodeNormal(ivec3(round(normal * float(kNormalOne)))), kNormals);
}

// The component of a normal along an axis.
float componentOf(vec3 normal, uint axis)
{
    return axis == 0u ? normal.x : axis == 1u ? normal.y : normal.z;
}

// The number of the face along an axis to the side of a normal.
uint faceAlong(uint axis, vec3 normal)
{
    return axis + (componentOf(normal, axis) < 0.0 ? 3u : 0u);
}

// A face by a random number in [0, 1): each with the square of the normal's component as its probability.
uint chosenFace(vec3 normal, float u)
{
    vec2 ends = vec2(normal.x * normal.x, normal.x * normal.x + normal.y * normal.y);
    return faceAlong(u < ends.x ? 0u : u < ends.y ? 1u : 2u, normal);
}

#endif
