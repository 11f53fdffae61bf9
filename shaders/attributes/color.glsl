// SPDX-License-Identifier: MIT
// Colours in 5, 6 and 5 bits: lib/attribute_formats.glsl unpacks them.
#ifndef ZVO_SHADERS_ATTRIBUTES_COLOR_GLSL
#define ZVO_SHADERS_ATTRIBUTES_COLOR_GLSL

#include "shared/attribute_formats.h"

// The channels of an attribute's colour.
uvec3 splitColor(uint color)
{
    return uvec3(color, color >> 8, color >> 16) & 255u;
}

// The channels whose unpacked values are nearest to 8-bit ones: c * 31 / 255 and c * 63 / 255, rounded.
uvec3 nearestColor565(uvec3 color)
{
    return (color * uvec3(249u, 253u, 249u) + uvec3(1014u, 505u, 1014u)) >> uvec3(11u, 10u, 11u);
}

uint packColor565(uvec3 channels)
{
    return channels.r | (channels.g << kRedBits) | (channels.b << (kRedBits + kGreenBits));
}

#endif
