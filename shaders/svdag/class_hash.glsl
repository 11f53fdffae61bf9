// SPDX-License-Identifier: MIT
// Hashes of nodes' contents. They never decide equality.
#ifndef ZVO_SHADERS_SVDAG_CLASS_HASH_GLSL
#define ZVO_SHADERS_SVDAG_CLASS_HASH_GLSL

// A bijection in which every bit of the input changes half of the output's (C. Wellons, Prospecting for Hash Functions,
// 2018: lowbias32).
uint mixBits(uint value)
{
    value ^= value >> 16;
    value *= 0x7FEB352Du;
    value ^= value >> 15;
    value *= 0x846CA68Bu;
    return value ^ (value >> 16);
}

uint hashMask(uint mask_lo, uint mask_hi)
{
    return mixBits(mask_lo ^ mixBits(mask_hi + 0x9E3779B9u));
}

#endif
