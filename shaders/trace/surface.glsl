// SPDX-License-Identifier: MIT
// The surface at a hit, without its emission.
// Needs the constants kNodeLevels and kFormat.
#ifndef ZVO_SHADERS_TRACE_SURFACE_GLSL
#define ZVO_SHADERS_TRACE_SURFACE_GLSL

#include "lib/attribute_formats.glsl"
#include "lib/color.glsl"
#include "lib/hit.glsl"
#include "lib/normal.glsl"
#include "shared/attribute_formats.h"
#include "shared/trace.h"

const vec3 kPlainAlbedo = vec3(0.6); // without attributes

struct Surface
{
    vec3 albedo;
    vec3 normal;
    bool may_emit; // a voxel that has to be looked up
};

Surface surfaceAt(Hit hit, vec3 direction, Attribute_ConstPtr attributes, Attribute_ConstPtr node_attributes)
{
    vec3 face_normal = faceNormal(hitFace(hit), direction);
    Surface surface = Surface(kPlainAlbedo, face_normal, false);
    if (kFormat != kFormatNone && !isMiss(hit))
    {
        bool voxel = hitLevel(hit) == kNodeLevels;
        Attribute stored = readAttribute(kFormat, voxel, attributes, node_attributes, hit.index);
        surface.albedo = decodeSrgb(unpackUnorm4x8(stored.color).rgb);
        surface.normal = shadingNormal(stored.normal, face_normal, direction);
        surface.may_emit = voxel && (kFormat != kFormat8 || ((stored.color >> 24) & kAttributeEmissive) != 0u);
    }
    return surface;
}

// The attribute of a voxel that was hit; nothing where `hits` is not set.
Attribute attributeAt(bool hits, Hit hit, Attribute_ConstPtr attributes)
{
    Attribute stored = Attribute(0u, 0u);
    if (kFormat != kFormatNone && hits)
        stored = readAttribute(kFormat, true, attributes, attributes, hit.index);
    return stored;
}

vec3 albedoOf(Attribute stored)
{
    return kFormat == kFormatNone ? kPlainAlbedo : decodeSrgb(unpackUnorm4x8(stored.color).rgb);
}

#endif
