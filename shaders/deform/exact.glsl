// SPDX-License-Identifier: MIT
// Arithmetic that gives the same bits on every device: single rounded operations, and no subnormal numbers.
#ifndef ZVO_SHADERS_DEFORM_EXACT_GLSL
#define ZVO_SHADERS_DEFORM_EXACT_GLSL

#include "deform/deform.h"

// v with components below 2^-100 replaced by 0.
vec3 dropTiny(vec3 v)
{
    return mix(v, vec3(0.0), lessThan(floatBitsToUint(v) << 1, uvec3(kTinyExponent << 24)));
}

vec3 product(vec3 v, float s)
{
    precise vec3 rounded = v * s;
    return dropTiny(rounded);
}

vec3 product(vec3 a, vec3 b)
{
    precise vec3 rounded = a * b;
    return dropTiny(rounded);
}

vec3 sum(vec3 a, vec3 b)
{
    precise vec3 rounded = a + b;
    return rounded;
}

// ((m[0] * v.x + m[1] * v.y) + m[2] * v.z)
vec3 transformed(mat3 m, vec3 v)
{
    return sum(sum(product(m[0], v.x), product(m[1], v.y)), product(m[2], v.z));
}

// a x b
vec3 crossProduct(vec3 a, vec3 b)
{
    return sum(product(a.yzx, b.zxy), -product(a.zxy, b.yzx));
}

// Whether the voxelizer can use v as a normal.
bool isDirection(vec3 v)
{
    uvec3 sizes = floatBitsToUint(v) << 1;
    uint exponent = max(max(sizes.x, sizes.y), sizes.z) >> 24;
    return exponent >= kDirectionExponentMin && exponent <= kDirectionExponentMax;
}

// The bits to write: zeros are positive, and all values that are not finite are one NaN, since devices differ in both.
uvec3 canonicalBits(vec3 v)
{
    uvec3 bits = floatBitsToUint(v);
    uvec3 size = bits << 1;
    bits = mix(bits, uvec3(kCanonicalNan), greaterThanEqual(size, uvec3(255u << 24)));
    return mix(bits, uvec3(0u), equal(size, uvec3(0u)));
}

#endif
