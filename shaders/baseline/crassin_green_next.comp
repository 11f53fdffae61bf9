#version 460
// SPDX-License-Identifier: MIT
// Sizes the passes over the next level, whose nodes are those that have been allocated last.
#extension GL_GOOGLE_include_directive : require
#include "baseline/crassin_green.glsl"
#include "lib/dispatch.glsl"

void main()
{
    if (threadIndex() != 0u)
        return;
    LevelRange above = params.ranges.data[params.level];
    uint first = above.first + above.count;
    uint tiles = min(params.tile_count.data[0], (params.node_capacity - 1u) / kTileNodes);
    uint count = 1u + kTileNodes * tiles - first;
    params.ranges.data[params.level + 1u] = LevelRange(first, count);
    params.args.data[params.level + 1u] =
        foldedArgs((count + kCrassinGreenGroup - 1u) / kCrassinGreenGroup, kGroupsXMax);
}
