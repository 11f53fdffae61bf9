// SPDX-License-Identifier: MIT
// Pairs of scales for the coordinates of a block's 16 points, x and y at once. In integers; 1 is 4095.
#ifndef ZVO_SHADERS_ATTRIBUTES_SCALES_GLSL
#define ZVO_SHADERS_ATTRIBUTES_SCALES_GLSL

#include "lib/attribute_formats.glsl"
#include "shared/attribute_formats.h"

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
