#version 460
// SPDX-License-Identifier: MIT
// Gives each flagged node of a level a tile, by an atomic counter: so the order of tiles depends on that of threads.
#extension GL_GOOGLE_include_directive : require
#include "baseline/crassin_green.glsl"
#include "lib/dispatch.glsl"

void main()
{
    LevelRange range = params.ranges.data[params.level];
    uint index = threadIndex();
    if (index >= range.count)
        return;
    uint node = range.first + index;
    if (params.nodes.data[node].child == 0u)
        return;
    uint first = 1u + kTileNodes * atomicAdd(params.tile_count.data[0], 1u);
    params.nodes.data[node].child = first + kTileNodes <= params.node_capacity ? first : 0u;
}
