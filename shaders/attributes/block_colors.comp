#version 460
// SPDX-License-Identifier: MIT
// Packs the colours of 16 voxels into 8 bytes: two colours in 5, 6 and 5 bits, and for each voxel an index that chooses
// one of these or of the two colours between them (the form of S3TC's DXT1). Four pairs are tried, and the one with the
// smallest sum of squared errors stays: the pair that is nearest to the mean; the corners of the colours' box on the
// diagonal along which they spread; and, twice, the least squares for the voxels' choices in the pair before. All in
// integers.
#extension GL_GOOGLE_include_directive : require
#include "attributes/attributes.h"

GPU_ENTRY(PackBlocksParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPackGroup) in;

#include "attributes/block.glsl"
#include "lib/attribute_formats.glsl"
#include "lib/dispatch.glsl"

const uint kRefinements = 2u;

// Of the pairs of codes around a colour, the one whose colour next to the first is nearest to it, channel by channel.
Pair pairAround(uvec3 color)
{
    uvec3 low = color * kChannelMax / 255u;
    uvec3 high = min(low + 1u, kChannelMax);
    uvec3 best_first = low;
    uvec3 best_second = low;
    uvec3 best_error = uvec3(~0u);
    for (uint i = 0u; i < 4u; ++i)
    {
        uvec3 first = (i & 1u) == 0u ? low : high;
        uvec3 second = (i & 2u) == 0u ? low : high;
        uvec3 met =
            (2u * unpackColor565(packColor565(first)) + unpackColor565(packColor565(second)) + 1u) / kColorIndexMax;
        uvec3 error = uvec3(abs(ivec3(met) - ivec3(color)));
        bvec3 better = lessThan(error, best_error);
        best_first = mix(best_first, first, better);
        best_second = mix(best_second, second, better);
        best_error = min(best_error, error);
    }
    return pairOf(best_first, best_second);
}

// Corners of the box around all colours, on the diagonal along which most of them lie. Their covariances with the
// channel that varies most decide which one that is.
Pair pairOfBox(uvec3 sum)
{
    uvec3 low = uvec3(255u);
    uvec3 high = uvec3(0u);
    ivec3 with_red = ivec3(0); // covariances, 256-fold
    ivec3 with_green = ivec3(0);
    ivec3 with_blue = ivec3(0);
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        low = min(low, colors[i]);
        high = max(high, colors[i]);
        ivec3 d = ivec3(colors[i] * kBlockVoxels) - ivec3(sum);
        with_red += d.r * d;
        with_green += d.g * d;
        with_blue += d.b * d;
    }
    ivec3 along = with_red;
    int most = with_red.r;
    if (with_green.g > most)
    {
        along = with_green;
        most = with_green.g;
    }
    if (with_blue.b > most)
        along = with_blue;
    bvec3 falling = lessThan(along, ivec3(0));
    return pairOf(nearestColor565(mix(low, high, falling)), nearestColor565(mix(high, low, falling)));
}

void main()
{
    uint block = threadIndex();
    if (block > (params.count - 1u) / kBlockVoxels)
        return;
    uint first = block * kBlockVoxels;
    uvec3 sum = uvec3(0u);
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        colors[i] = splitColor(params.attributes.data[min(first + i, params.count - 1u)].color);
        sum += colors[i];
    }
    Pair best = pairAround((sum + kBlockVoxels / 2u) / kBlockVoxels);
    choose(best);
    Pair next = pairOfBox(sum);
    for (uint i = 0u; i <= kRefinements; ++i)
    {
        choose(next);
        if (next.error < best.error)
            best = next;
        next = leastSquares(next);
    }
    params.words.data[block * kBlockWords] = best.ends;
    params.words.data[block * kBlockWords + kBlockColorIndices] = best.indices;
}
