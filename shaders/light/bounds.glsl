// SPDX-License-Identifier: MIT
// Packing of the bounds and sums of a node of the light tree (light/light_tree.h).
#ifndef ZVO_SHADERS_LIGHT_BOUNDS_GLSL
#define ZVO_SHADERS_LIGHT_BOUNDS_GLSL

#include "light/light_tree.h"

const uint kLightPartMax = (1u << kLightPartBits) - 1u;

uvec2 packLightCell(uvec3 cell)
{
    return uvec2(cell.x | (cell.y << 18), (cell.y >> 14) | (cell.z << 4));
}

uvec3 unpackLightCell(uvec2 packed)
{
    return uvec3(packed.x, (packed.x >> 18) | (packed.y << 14), packed.y >> 4) & 0x3FFFFu;
}

uint packLightParts(vec3 up, vec3 down, float power)
{
    float scale = float(kLightPartMax) / max(power, 1.17549435e-38);
    uvec3 up_parts = min(uvec3(ceil(up * scale)), uvec3(kLightPartMax));
    uvec3 down_parts = min(uvec3(ceil(down * scale)), uvec3(kLightPartMax));
    return up_parts.x | (up_parts.y << kLightPartBits) | (up_parts.z << (2u * kLightPartBits)) |
           (down_parts.x << (3u * kLightPartBits)) | (down_parts.y << (4u * kLightPartBits)) |
           (down_parts.z << (5u * kLightPartBits));
}

// The parts towards +x, +y and +z, or with first 3 those towards -x, -y and -z.
vec3 unpackLightParts(uint parts, uint first)
{
    uint shifted = parts >> (first * kLightPartBits);
    return vec3(uvec3(shifted, shifted >> kLightPartBits, shifted >> (2u * kLightPartBits)) & kLightPartMax) *
           (1.0 / float(kLightPartMax));
}

#endif
