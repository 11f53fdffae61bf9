// SPDX-License-Identifier: MIT
// Octahedral codes of normals, in integers, so that every device packs the same bytes.
#include "lib/divide.glsl"

const int kNormalOne = 32767;             // 1 as a snorm16
const uint kNormalSumBits = 15u;          // components are shortened to this many bits before they are divided
const uint kNormalMask = (1u << 16) - 1u; // of a coordinate in a code

// Octahedral coordinates of a vector from its signs and the absolute values of x and y, where those of all three add up
// to `one`.
ivec2 foldNormal(ivec2 size, ivec3 v, int one)
{
    ivec2 p = v.z < 0 ? one - size.yx : size;
    p.x = v.x < 0 ? -p.x : p.x;
    p.y = v.y < 0 ? -p.y : p.y;
    return p;
}

// The octahedral code of two snorm16.
uint normalCode(ivec2 p)
{
    return (uint(p.x) & kNormalMask) | (uint(p.y) << 16);
}

// Octahedral code of the direction of v (Cigolle et al., A Survey of Efficient Representations for Independent Unit
// Vectors, 2014). The zero vector becomes +z.
uint encodeNormal(ivec3 v)
{
    uvec3 size = uvec3(abs(v));
    int shift = max(findMSB(size.x | size.y | size.z) + 1 - int(kNormalSumBits), 0);
    size >>= shift;
    uint sum = max(size.x + size.y + size.z, 1u);
    return normalCode(foldNormal(ivec2(divideSmall(size.xy * uint(kNormalOne) + sum / 2u, sum)), v, kNormalOne));
}

// Vector of octahedral coordinates in which 1 is `one`; the components' absolute values add up to that.
ivec3 unfoldNormal(ivec2 p, int one)
{
    int z = one - abs(p.x) - abs(p.y);
    ivec2 folded = ivec2(p.x < 0 ? abs(p.y) - one : one - abs(p.y), p.y < 0 ? abs(p.x) - one : one - abs(p.x));
    return ivec3(z < 0 ? folded : p, z);
}

// The two snorm16 of an octahedral code.
ivec2 normalCoordinates(uint code)
{
    return ivec2(int(code << 16) >> 16, int(code) >> 16);
}

// Vector in the direction of an octahedral code; the components' absolute values add up to kNormalOne.
ivec3 decodeNormal(uint code)
{
    return unfoldNormal(normalCoordinates(code), kNormalOne);
}
