// SPDX-License-Identifier: MIT
// Rays in unit space (shared/trace.h), where the coordinates of cells are mantissa bits of floats in [1, 2): making
// rays for the traversal, and loading and storing them as 64-bit words: lavapipe pays per word, not per byte.
#ifndef ZVO_SHADERS_LIB_RAY_GLSL
#define ZVO_SHADERS_LIB_RAY_GLSL

#include "lib/arithmetic.glsl"
#include "shared/trace.h"

const uint kMantissaBits = 23u;
const uint kRootShift = kMantissaBits - 2u; // of the mantissa bits that number the root's cells

// Length in unit space of this many mantissa steps.
float edgeOf(uint size)
{
    return float(size) / float(1u << kMantissaBits);
}

// The bits of a cell's number in its block (lib/morton.glsl) that are inverted where these axes are mirrored.
uint mirrorBits(bvec3 mirrored)
{
    return (mirrored.x ? 9u : 0u) | (mirrored.y ? 18u : 0u) | (mirrored.z ? 36u : 0u);
}

const float kDirectionMin = 1e-20; // smaller components of a direction count as this

// 1 / direction with components that are too small replaced, their sign kept: no component is zero or infinite.
vec3 inverseDirection(vec3 direction)
{
    vec3 smallest = uintBitsToFloat(floatBitsToUint(vec3(kDirectionMin)) | (floatBitsToUint(direction) & (1u << 31)));
    return 1.0 / mix(direction, smallest, lessThan(abs(direction), vec3(kDirectionMin)));
}

// Whether traverse() takes the ray.
bool isTraceable(Ray ray)
{
    vec3 size = abs(ray.inverse_direction);
    return isFinite(ray.origin) && isFinite(size) && min(size.x, min(size.y, size.z)) >= kTraceTimeMin &&
           isFinite(ray.t_min) && !isNan(ray.t_max);
}

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
