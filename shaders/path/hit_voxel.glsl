// SPDX-License-Identifier: MIT
// Voxels that rays have hit. The includer includes lib/attribute_formats.glsl, lib/color.glsl and trace/surface.glsl
// before and declares kFormat and params.
#ifndef ZVO_SHADERS_PATH_HIT_VOXEL_GLSL
#define ZVO_SHADERS_PATH_HIT_VOXEL_GLSL

#include "lib/attribute_formats.glsl"
#include "lib/color.glsl"
#include "shared/attribute_formats.h"
#include "shared/trace.h"
#include "trace/surface.glsl"

// The attribute of a voxel that was hit.
Attribute attributeAt(bool hits, Hit hit)
{
    Attribute stored = Attribute(0u, 0u);
    if (kFormat != kFormatNone && hits)
        stored = readAttribute(kFormat, true, params.attributes, params.attributes, hit.index);
    return stored;
}

vec3 albedoOf(Attribute stored)
{
    return kFormat == kFormatNone ? kPlainAlbedo : decodeSrgb(unpackUnorm4x8(stored.color).rgb);
}

#endif
