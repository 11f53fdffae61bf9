#version 460
// SPDX-License-Identifier: MIT
// Gives each node of a level the mean of its occupied children.
#extension GL_GOOGLE_include_directive : require
#include "baseline/crassin_green.glsl"
#include "baseline/mean.glsl"
#include "lib/dispatch.glsl"

void main()
{
    LevelRange range = params.ranges.data[params.level];
    uint index = threadIndex();
    if (index >= range.count)
        return;
    uint tile = params.nodes.data[range.first + index].child;
    if (tile == 0u)
        return;
    MeanSums sums = noSums();
    [[unroll]] for (uint i = 0u; i < kTileNodes; ++i)
        addToMean(params.nodes.data[tile + i], sums);
    params.nodes.data[range.first + index] = meanNode(sums, tile);
}
