// SPDX-License-Identifier: MIT
// Attributes of the 16 voxels of a block, which lib/attribute_formats.glsl unpacks: pairs of colours in 5, 6 and 5
// bits, and pairs of scales for the coordinates of normals, x and y at once. In integers.
#ifndef ZVO_SHADERS_ATTRIBUTES_BLOCK_GLSL
#define ZVO_SHADERS_ATTRIBUTES_BLOCK_GLSL

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

// Scales. 1 is 4095.
const uint kStep = 65u;                      // from one end to the next
const int kOne = kNormalEnd * int(kStep);    // 1 in coordinates and vectors
const uint kInverseBits = 18u;               // of kNormalIndexMax / length of a scale
const uint kCoordinateMax = kEndMax * kStep; // coordinates are counted from -1

uvec2 points[kBlockVoxels]; // of the block's voxels

/// The scales of x and y, the voxels' steps, and their errors.
struct Scales
{
    uvec2 first; // ends
    uvec2 second;
    uvec3 planes; // bits of the voxels' steps, as they are stored
    uvec2 error;  // sums of squares: 16 * 8190^2 at most
};

// The coordinates at a step of both scales, rounded.
uvec2 pointAt(Scales scales, uvec2 steps)
{
    uvec2 sum = scales.first * (kNormalIndexMax - steps) + scales.second * steps;
    return (sum * kStep + kNormalIndexMax / 2u) / kNormalIndexMax;
}

// The bits that blockIndices reads for that voxel.
uvec3 planesOf(uvec2 steps, uint voxel)
{
    const uvec3 bits = uvec3(0u, 1u, 2u);
    return (((uvec3(steps.x) >> bits) & 1u) << voxel) | (((uvec3(steps.y) >> bits) & 1u) << (voxel + kBlockVoxels));
}

// Chooses the nearest step for each voxel.
void choose(inout Scales scales)
{
    uvec2 reach = (scales.second - scales.first) * kStep;
    uvec2 inverse = mix((kNormalIndexMax << kInverseBits) / max(reach, uvec2(1u)), uvec2(0u), equal(reach, uvec2(0u)));
    scales.planes = uvec3(0u);
    scales.error = uvec2(0u);
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        ivec2 along = (ivec2(points[i]) - ivec2(scales.first * kStep)) * ivec2(inverse);
        uvec2 steps = uvec2(clamp((along + (1 << (kInverseBits - 1u))) >> int(kInverseBits), 0, int(kNormalIndexMax)));
        scales.planes |= planesOf(steps, i);
        ivec2 d = ivec2(pointAt(scales, steps)) - ivec2(points[i]);
        scales.error += uvec2(d * d);
    }
}

// The scales from the least to the greatest coordinates.
Scales fullScales()
{
    uvec2 least = points[0];
    uvec2 greatest = points[0];
    for (uint i = 1u; i < kBlockVoxels; ++i)
    {
        least = min(least, points[i]);
        greatest = max(greatest, points[i]);
    }
    Scales scales;
    scales.first = min((least + kStep / 2u) / kStep, uvec2(kEndMax));
    scales.second = min((greatest + kStep / 2u) / kStep, uvec2(kEndMax));
    choose(scales);
    return scales;
}

// An end by least squares: kNormalIndexMax * numerator / denominator in steps of ends.
uvec2 endOf(ivec2 numerator, uvec2 denominator)
{
    uvec2 n = min(uvec2(max(numerator, ivec2(0))), denominator * (kCoordinateMax / kNormalIndexMax + 1u));
    uvec2 quotient = n / denominator;
    uvec2 coordinate = kNormalIndexMax * quotient + kNormalIndexMax * (n - quotient * denominator) / denominator;
    return min((coordinate + kStep / 2u) / kStep, uvec2(kEndMax));
}

// The scales with the smallest error if voxels keep their steps; where all have the same one, the scale itself.
Scales leastSquares(Scales scales)
{
    uvec2 aa = uvec2(0u); // of weights a of the first and b of the second end
    uvec2 ab = uvec2(0u);
    uvec2 bb = uvec2(0u);
    ivec2 ac = ivec2(0);
    ivec2 bc = ivec2(0);
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        uvec2 b = blockIndices(scales.planes, i);
        uvec2 a = kNormalIndexMax - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ac += ivec2(a * points[i]);
        bc += ivec2(b * points[i]);
    }
    uvec2 determinant = aa * bb - ab * ab;
    bvec2 none = equal(determinant, uvec2(0u));
    determinant = max(determinant, uvec2(1u));
    uvec2 first = endOf(ac * ivec2(bb) - bc * ivec2(ab), determinant);
    uvec2 second = endOf(bc * ivec2(aa) - ac * ivec2(ab), determinant);
    scales.first = mix(first, scales.first, none);
    scales.second = max(mix(second, scales.second, none), scales.first);
    choose(scales);
    return scales;
}

// The better scale for each coordinate; of equally good ones, the first.
Scales better(Scales a, Scales b)
{
    bvec2 is_b = lessThan(b.error, a.error);
    const uint of_x = (1u << kBlockVoxels) - 1u; // bits of a plane
    uint of_b = (is_b.x ? of_x : 0u) | (is_b.y ? ~of_x : 0u);
    return Scales(mix(a.first, b.first, is_b), mix(a.second, b.second, is_b), (a.planes & ~of_b) | (b.planes & of_b),
                  min(a.error, b.error));
}

#endif
