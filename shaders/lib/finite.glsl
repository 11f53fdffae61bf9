// SPDX-License-Identifier: MIT
// Classifies floats by their bits, as devices may assume that there is neither NaN nor infinity.

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
