// SPDX-License-Identifier: MIT
// Normals: octahedral codes, in integers, so that every device packs the same bytes; and the normals of hits.
#ifndef ZVO_SHADERS_LIB_NORMAL_GLSL
#define ZVO_SHADERS_LIB_NORMAL_GLSL

#include "lib/arithmetic.glsl"
#include "shared/octree.h"
#include "shared/trace.h"

const int kNormalOne = 32767;             // 1 as a snorm16
const uint kNormalSumBits = 15u;          // components are shortened to this many bits before they are divided
const uint kNoNormalRatio = 4u;           // a mean of unit vectors that is shorter than 1 / 4 has no direction
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

// By how many bits components of this size are shortened.
int normalShift(uvec3 size)
{
    return max(findMSB(size.x | size.y | size.z) + 1 - int(kNormalSumBits), 0);
}

// Octahedral code of the direction of v (Cigolle et al., A Survey of Efficient Representations for Independent Unit
// Vectors, 2014). The zero vector becomes +z.
uint encodeNormal(ivec3 v)
{
    uvec3 size = uvec3(abs(v));
    size >>= normalShift(size);
    uint sum = max(size.x + size.y + size.z, 1u);
    return normalCode(foldNormal(ivec2(divideSmall(size.xy * uint(kNormalOne) + sum / 2u, sum)), v, kNormalOne));
}

// The code of the mean of `count` vectors that have the length `one` at most: kNoNormal if the mean is shorter than
// one / kNoNormalRatio. count * one < 2^31; sum: that of the vectors.
uint encodeMeanNormal(ivec3 sum, uint count, uint one)
{
    uvec3 size = uvec3(abs(sum));
    int shift = normalShift(size);
    size >>= shift;
    uint least = min(count * one / kNoNormalRatio >> shift, kNormalMask); // components below 2^15 make no longer vector
    bool is_short = size.x * size.x + size.y * size.y + size.z * size.z < least * least;
    return is_short ? kNoNormal : encodeNormal(sum);
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

// Vector in the direction of an octahedral code; the components' absolute values add up to kNormalOne. Zero for
// kNoNormal.
ivec3 decodeNormal(uint code)
{
    return code == kNoNormal ? ivec3(0) : unfoldNormal(normalCoordinates(code), kNormalOne);
}

// Normal of the face that the ray came in through; against the ray when it started inside.
vec3 faceNormal(uint face, vec3 direction)
{
    vec3 axis = vec3(face == 0u ? 1.0 : 0.0, face == 1u ? 1.0 : 0.0, face == 2u ? 1.0 : 0.0);
    return face == kFaceInside ? -normalize(direction) : mix(axis, -axis, greaterThan(direction, vec3(0.0)));
}

// From this cosine between a normal and the viewer's direction on, a surface is seen from behind. At the rim of a
// surface its normal may point away from the viewer without that, the more so the coarser the surface's triangles are.
const float kSeenFromBehind = 0.5;
// Where it points away less, it is seen from behind if the cosine between it and the normal of the face that the viewer
// sees is below this: a floor whose triangles are wound as a ceiling's.
const float kAgainstFace = -0.5;

// Normal of an attribute, turned round if the surface is seen from behind; face_normal if it has none. Nearly always all
// faces of a voxel have the same one, so neighbouring pixels do.
vec3 shadingNormal(uint code, vec3 face_normal, vec3 direction)
{
    if (code == kNoNormal)
        return face_normal;
    vec3 normal = normalize(vec3(decodeNormal(code)));
    float away = dot(normal, direction);
    bool is_behind = away > kSeenFromBehind * length(direction) || (away > 0.0 && dot(normal, face_normal) < kAgainstFace);
    return is_behind ? -normal : normal;
}

#endif
