#version 460
// SPDX-License-Identifier: MIT
// Lists the row blocks of big triangles, kStripLanes threads for each band of rows. Blocks that the triangle's outline,
// or its plane inside the grid, does not reach are left out, so the work follows the covered area and not the bounding
// box.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"

GPU_ENTRY(RasterParams, RASTER_CONSTANTS);
layout(local_size_x = kBandsGroup) in;

#include "voxelize/constants.glsl"
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/big_triangle.glsl"
#include "voxelize/raster.glsl"

void listBlocks(uint band, uint strip, uvec2 blocks)
{
    uint count = blocks.y - blocks.x + 1u;
    uint first = atomicAdd(params.counters.data[0].block_count, count);
    if (first > kRowBlocksMax)
        atomicMax(params.counters.data[0].blocks_exceeded, 1u);
    for (uint i = 0u; i < count; ++i)
        if (first + i < params.block_capacity)
            params.row_blocks.data[first + i] = RowBlock(band, packBlock(uvec2(blocks.x + i, strip)));
}

// Every kStripLanes-th strip of a band, from number lane on.
void listStrips(uint band, uint lane)
{
    BigTriangle big = params.big_triangles.data[band];
    i64vec3 normal;
    RasterTriangle t = setupBigTriangle(big, normal);
    ivec2 origin = blockOrigin(t.low.xy);
    int column_count = t.high.x - origin.x + 1;
    uint first_strip = big.band * kBandStrips;
    uint strip_count = uint(t.high.y - origin.y) / kBlockRows + 1u;
    uint last_strip = min(first_strip + kBandStrips, strip_count);
    for (uint strip = first_strip + lane; strip < last_strip; strip += kStripLanes)
    {
        RasterCell cell = startColumn(t, origin + ivec2(0, int(strip * kBlockRows)));
        vec2 interval = outlineColumns(t, cell, column_count, int(kBlockRows));
        ivec2 columns = wholeColumns(layerColumns(t, cell, interval, int(kBlockRows)));
        columns.y = min(columns.y, column_count - 1);
        if (columns.x <= columns.y)
            listBlocks(band, strip, uvec2(columns) / kBlockColumns);
    }
}

// The last subgroup sizes voxelize/rows.
void sizeRows(uint group_count)
{
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kBandsGroup) && subgroupElect())
    {
        uint blocks = min(atomicOr(params.counters.data[0].block_count, 0u), params.block_capacity);
        params.counters.data[0].rows = foldedArgs((blocks * kBlockRows + kRowsGroup - 1u) / kRowsGroup, kGroupsXMax);
        atomicExchange(params.counters.data[0].arrived, 0u);
    }
}

void main()
{
    uint band_count = min(params.counters.data[0].big_count, params.big_capacity);
    uint group_count = bandGroups(band_count);
    if (workgroupIndex() >= group_count)
        return;
    uint band = workgroupIndex() * kGroupBands + gl_LocalInvocationIndex / kStripLanes;
    if (band < band_count)
        listStrips(band, gl_LocalInvocationIndex % kStripLanes);
    sizeRows(group_count);
}
