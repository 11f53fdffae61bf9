// SPDX-License-Identifier: MIT
// Sums of what the camera sees. The includer includes path/path.h before.
#ifndef ZVO_SHADERS_RADIANCE_SEEN_SUM_GLSL
#define ZVO_SHADERS_RADIANCE_SEEN_SUM_GLSL

#include "path/path.h"

void setRadiance(PixelSum_Ptr sums, uint pixel, vec3 radiance)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(sums));
    words.data[2u * pixel] = packUint2x32(floatBitsToUint(radiance.rg));
    words.data[2u * pixel + 1u] = uint64_t(floatBitsToUint(radiance.b));
}

// Adds radiance to a pixel, of which no other thread has any at the same time. In words of 64 bits: lavapipe pays per
// word.
void addRadiance(PixelSum_Ptr sums, uint pixel, vec3 radiance)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(sums));
    vec2 red_green = uintBitsToFloat(unpackUint2x32(words.data[2u * pixel]));
    vec2 blue = uintBitsToFloat(unpackUint2x32(words.data[2u * pixel + 1u]));
    words.data[2u * pixel] = packUint2x32(floatBitsToUint(red_green + radiance.rg));
    words.data[2u * pixel + 1u] = packUint2x32(floatBitsToUint(vec2(blue.x + radiance.b, blue.y)));
}

#endif
