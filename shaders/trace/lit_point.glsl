// SPDX-License-Identifier: MIT
// The origin of rays that gather light for a hit: rays that begin below the root, as trace/traverse_paths.glsl traces
// them. With kSmooth light arrives by the normal of the voxel, else by that of its face.
// Needs the constant kSmooth.
#ifndef ZVO_SHADERS_TRACE_LIT_POINT_GLSL
#define ZVO_SHADERS_TRACE_LIT_POINT_GLSL

#include "lib/attribute_formats.glsl"
#include "lib/hit.glsl"
#include "lib/normal.glsl"
#include "shared/attribute_formats.h"
#include "shared/trace.h"
#include "trace/traverse_paths.glsl"

struct LitPoint
{
    vec3 normal;
    vec3 origin; // above the middle of the voxel
    float edge;  // of the voxel, in unit space
};

// The origin is lifted along both normals, so that neither the voxel nor the steps of the surface around it occlude.
const float kLiftFace = 0.75; // voxels
const float kLiftNormal = 0.75;

// direction: of the ray that hit; format: of attributes. The pointers are not used without attributes, nor for a miss.
LitPoint litPoint(Hit hit, vec3 direction, uint format, Attribute_ConstPtr voxels, Attribute_ConstPtr nodes)
{
    vec3 face_normal = faceNormal(hitFace(hit), direction);
    LitPoint point;
    point.normal = face_normal;
    if (kSmooth && format != kFormatNone && !isMiss(hit))
    {
        bool voxel = !kDetail || hitLevel(hit) == kNodeLevels;
        point.normal =
            shadingNormal(readAttribute(format, voxel, voxels, nodes, hit.index).normal, face_normal, direction);
    }
    point.edge = exp2(-2.0 * float(hitLevel(hit)));
    vec3 middle = 1.0 + (vec3(hitCell(hit)) + 0.5) * point.edge;
    point.origin = middle + point.edge * (kLiftFace * face_normal + kLiftNormal * point.normal);
    return point;
}

#endif
