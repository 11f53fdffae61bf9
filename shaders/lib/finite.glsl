// SPDX-License-Identifier: MIT
// Classifies floats by their bits, as devices may assume that there is neither NaN nor infinity.
#ifndef ZVO_SHADERS_LIB_FINITE_GLSL
#define ZVO_SHADERS_LIB_FINITE_GLSL

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
