// SPDX-License-Identifier: MIT
// Loads and stores of rays as 64-bit words: lavapipe pays per word, not per byte. The includer includes shared/trace.h
// before.
#ifndef ZVO_SHADERS_LIB_RAY_WORDS_GLSL
#define ZVO_SHADERS_LIB_RAY_WORDS_GLSL

#include "shared/trace.h"

Ray loadRay(Ray_ConstPtr rays, uint i)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(rays));
    vec2 a = uintBitsToFloat(unpackUint2x32(words.data[4u * i]));
    vec2 b = uintBitsToFloat(unpackUint2x32(words.data[4u * i + 1u]));
    vec2 c = uintBitsToFloat(unpackUint2x32(words.data[4u * i + 2u]));
    vec2 d = uintBitsToFloat(unpackUint2x32(words.data[4u * i + 3u]));
    return Ray(vec3(a, b.x), b.y, vec3(c, d.x), d.y);
}

void storeRay(Ray_Ptr rays, uint i, Ray ray)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(rays));
    words.data[4u * i] = packUint2x32(floatBitsToUint(ray.origin.xy));
    words.data[4u * i + 1u] = packUint2x32(floatBitsToUint(vec2(ray.origin.z, ray.t_min)));
    words.data[4u * i + 2u] = packUint2x32(floatBitsToUint(ray.inverse_direction.xy));
    words.data[4u * i + 3u] = packUint2x32(floatBitsToUint(vec2(ray.inverse_direction.z, ray.t_max)));
}

#endif
