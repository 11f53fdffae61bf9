// SPDX-License-Identifier: MIT
// Arithmetic on which devices spend too much, or differ: integer division without dozens of instructions, and what kind
// of number a float is, by its bits.
#ifndef ZVO_SHADERS_LIB_ARITHMETIC_GLSL
#define ZVO_SHADERS_LIB_ARITHMETIC_GLSL

// floor(a / b) for quotients up to 2^17 and b below 2^30: estimated in floating point, which is off by one at most
// there, and corrected by the exact remainder.
uint divideSmall(uint a, uint b)
{
    uint quotient = uint(float(a) * (1.0 / float(b)));
    int rest = int(a - quotient * b);
    return rest < 0 ? quotient - 1u : (rest >= int(b) ? quotient + 1u : quotient);
}

uvec2 divideSmall(uvec2 a, uint b)
{
    uvec2 quotient = uvec2(vec2(a) * (1.0 / float(b)));
    ivec2 rest = ivec2(a - quotient * b);
    return quotient - uvec2(lessThan(rest, ivec2(0))) + uvec2(greaterThanEqual(rest, ivec2(int(b))));
}

uvec3 divideSmall(uvec3 a, uint b)
{
    uvec3 quotient = uvec3(vec3(a) * (1.0 / float(b)));
    ivec3 rest = ivec3(a - quotient * b);
    return quotient - uvec3(lessThan(rest, ivec3(0))) + uvec3(greaterThanEqual(rest, ivec3(int(b))));
}

// Devices may assume that there is neither NaN nor infinity, so floats are classified by their bits.
bool isFinite(float x)
{
    return (floatBitsToUint(x) << 1) < (255u << 24); // the exponent is not all ones
}

bool isNan(float x)
{
    return (floatBitsToUint(x) << 1) > (255u << 24);
}

bool isFinite(vec3 v)
{
    return isFinite(v.x) && isFinite(v.y) && isFinite(v.z);
}

#endif
