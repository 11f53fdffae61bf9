// SPDX-License-Identifier: MIT
// Normals of hits.
#ifndef ZVO_SHADERS_LIB_SURFACE_NORMAL_GLSL
#define ZVO_SHADERS_LIB_SURFACE_NORMAL_GLSL

#include "lib/normal_code.glsl"
#include "shared/octree.h"
#include "shared/trace.h"

// Normal of the face that the ray came in through; against the ray when it started inside.
vec3 faceNormal(uint face, vec3 direction)
{
    vec3 axis = vec3(face == 0u ? 1.0 : 0.0, face == 1u ? 1.0 : 0.0, face == 2u ? 1.0 : 0.0);
    return face == kFaceInside ? -normalize(direction) : mix(axis, -axis, greaterThan(direction, vec3(0.0)));
}

// Normal of an attribute, turned round if the surface is seen from behind; face_normal if it has none. At the rim of a
// surface its normal may point away from the viewer a little without that.
vec3 shadingNormal(uint code, vec3 face_normal, vec3 direction)
{
    if (code == kNoNormal)
        return face_normal;
    vec3 normal = normalize(vec3(decodeNormal(code)));
    return dot(normal, face_normal) < 0.0 && dot(normal, direction) > 0.0 ? -normal : normal;
}

#endif
