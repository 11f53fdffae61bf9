// SPDX-License-Identifier: MIT
// Loads, stores and sums of features; they move as 64-bit words, as rays do. The includer includes path/path.h before.
#ifndef ZVO_SHADERS_PATH_FEATURES_GLSL
#define ZVO_SHADERS_PATH_FEATURES_GLSL

#include "path/path.h"

PixelFeatures loadFeatures(PixelFeatures_ConstPtr features, uint i)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(features));
    vec2 a = uintBitsToFloat(unpackUint2x32(words.data[6u * i]));
    vec2 b = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 1u]));
    vec2 c = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 2u]));
    vec2 d = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 3u]));
    vec2 e = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 4u]));
    vec2 f = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 5u]));
    return PixelFeatures(vec3(a, b.x), b.y, vec3(c, d.x), d.y, vec3(e, f.x), f.y);
}

void storeFeatures(PixelFeatures_Ptr features, uint i, PixelFeatures sum)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(features));
    words.data[6u * i] = packUint2x32(floatBitsToUint(sum.albedo.xy));
    words.data[6u * i + 1u] = packUint2x32(floatBitsToUint(vec2(sum.albedo.z, sum.depth)));
    words.data[6u * i + 2u] = packUint2x32(floatBitsToUint(sum.normal.xy));
    words.data[6u * i + 3u] = packUint2x32(floatBitsToUint(vec2(sum.normal.z, sum.hits)));
    words.data[6u * i + 4u] = packUint2x32(floatBitsToUint(sum.direct.xy));
    words.data[6u * i + 5u] = packUint2x32(floatBitsToUint(vec2(sum.direct.z, sum.scattered_squared)));
}

#endif
