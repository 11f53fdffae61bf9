// SPDX-License-Identifier: MIT
// Pixels in the formats in which pictures store them (kTexelRgba8 and so on in trace/light.h).
#ifndef ZVO_SHADERS_TRACE_TEXEL_GLSL
#define ZVO_SHADERS_TRACE_TEXEL_GLSL

#include "lib/color.glsl"
#include "trace/light.h"

// The largest code of red, green and blue.
float texelSteps(uint texels)
{
    return texels == kTexelRgb10 ? 1023.0 : 255.0;
}

// The texel's values for radiance: codes in [0, 1], or for half floats the exposed radiance itself.
vec3 developTexel(uint texels, vec3 radiance, float exposure, uvec2 pixel)
{
    if (texels == kTexelHalf)
        return exposure * radiance;
    return develop(radiance, exposure, pixel, texelSteps(texels));
}

uint packCodes(uint texels, vec3 color)
{
    uvec3 code = uvec3(color * texelSteps(texels) + 0.5);
    if (texels == kTexelRgb10)
        return code.r | (code.g << 10) | (code.b << 20) | (3u << 30);
    if (texels == kTexelBgra8)
        return code.b | (code.g << 8) | (code.r << 16) | (255u << 24);
    return packColor8(color);
}

// Values above the largest half float become that, not infinite.
uint64_t packHalfs(vec3 color)
{
    vec3 finite = clamp(color, 0.0, kHalfMax);
    return packUint2x32(uvec2(packHalf2x16(finite.rg), packHalf2x16(vec2(finite.b, 1.0))));
}

// color: codes in [0, 1], or in half floats linear, from 0 on. Alpha is 1.
void storeTexel(uint texels, uint_Ptr image, uint pixel, vec3 color)
{
    if (texels == kTexelHalf)
        uint64_t_Ptr(uint64_t(image)).data[pixel] = packHalfs(color);
    else
        image.data[pixel] = packCodes(texels, color);
}

#endif
