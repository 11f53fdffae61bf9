// SPDX-License-Identifier: MIT
// Colours in 5, 6 and 5 bits, which lib/attribute_formats.glsl unpacks, and pairs of them for the 16 voxels of a block.
#ifndef ZVO_SHADERS_ATTRIBUTES_COLOR_PAIR_GLSL
#define ZVO_SHADERS_ATTRIBUTES_COLOR_PAIR_GLSL

#include "lib/attribute_formats.glsl"
#include "shared/attribute_formats.h"

// The channels of an attribute's colour.
uvec3 splitColor(uint color)
{
    return uvec3(color, color >> 8, color >> 16) & 255u;
}

// The channels whose unpacked values are nearest to 8-bit ones: c * 31 / 255 and c * 63 / 255, rounded.
uvec3 nearestColor565(uvec3 color)
{
    return (color * uvec3(249u, 253u, 249u) + uvec3(1014u, 505u, 1014u)) >> uvec3(11u, 10u, 11u);
}

uint packColor565(uvec3 channels)
{
    return channels.r | (channels.g << kRedBits) | (channels.b << (kRedBits + kGreenBits));
}

const uvec3 kChannelMax = uvec3((1u << kRedBits) - 1u, (1u << kGreenBits) - 1u, (1u << kBlueBits) - 1u);

uvec3 colors[kBlockVoxels]; // of the block's voxels

/// A pair of colours, the voxels' choices, and their error.
struct Pair
{
    uint ends;
    uint indices;
    uint error; // sum of squares: 16 * 3 * 255^2 at most
};

Pair pairOf(uvec3 first, uvec3 second)
{
    return Pair(packColor565(first) | (packColor565(second) << 16), 0u, 0u);
}

uint distance2(uvec3 a, uvec3 b)
{
    ivec3 d = ivec3(a) - ivec3(b);
    return uint(d.r * d.r + d.g * d.g + d.b * d.b);
}

// Chooses the nearest colour for each voxel; of several, the first.
void choose(inout Pair pair)
{
    uvec3 first = unpackColor565(pair.ends);
    uvec3 second = unpackColor565(pair.ends >> 16);
    uvec3 near_first = (2u * first + second + 1u) / kColorIndexMax;
    uvec3 near_second = (first + 2u * second + 1u) / kColorIndexMax;
    pair.indices = 0u;
    pair.error = 0u;
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        // An index in the lowest bits breaks ties.
        uvec4 candidates = uvec4(distance2(colors[i], first) * 4u, distance2(colors[i], near_first) * 4u + 1u,
                                 distance2(colors[i], near_second) * 4u + 2u, distance2(colors[i], second) * 4u + 3u);
        uint best = min(min(candidates.x, candidates.y), min(candidates.z, candidates.w));
        pair.indices |= (best & 3u) << (2u * i);
        pair.error += best >> 2;
    }
}

// An end by least squares: channel * max / 255 with channel = kColorIndexMax * numerator / denominator.
uvec3 endOf(ivec3 numerator, uint denominator)
{
    uint whole = 255u * denominator;
    uvec3 scaled = uvec3(max(numerator, ivec3(0))) * kColorIndexMax * kChannelMax;
    return min((2u * scaled + whole) / (2u * whole), kChannelMax);
}

// The pair with the smallest error if voxels keep their choices; if all have chosen the same, the pair itself.
Pair leastSquares(Pair pair)
{
    uint aa = 0u; // of weights a of the first and b of the second colour
    uint ab = 0u;
    uint bb = 0u;
    ivec3 ac = ivec3(0);
    ivec3 bc = ivec3(0);
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        uint b = (pair.indices >> (2u * i)) & kColorIndexMax;
        uint a = kColorIndexMax - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ac += ivec3(a * colors[i]);
        bc += ivec3(b * colors[i]);
    }
    uint determinant = aa * bb - ab * ab;
    if (determinant == 0u)
        return pair;
    return pairOf(endOf(ac * int(bb) - bc * int(ab), determinant), endOf(bc * int(aa) - ac * int(ab), determinant));
}

#endif
