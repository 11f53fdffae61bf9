#version 460
// SPDX-License-Identifier: MIT
// Rasterizes big triangles, one thread a row of at most kBlockColumns columns, or tiles of the same block, in 64-bit
// integers. The work follows the rows that the triangle really crosses: columns outside of its outline in the (u, v)
// projection are left out.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/constants.glsl"
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#define BRICKS_CONSTANT_ID 4
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/shading.glsl"
#include "voxelize/vertex.glsl"
#include "voxelize/surface.glsl"
#include "voxelize/fragment.glsl"
#include "voxelize/tile.glsl"

layout(local_size_x = kRowsGroup) in;

// Columns that can lie inside the outline, as offsets from the cell's column: where each edge function, linear along
// the row, is not negative. Estimated in floating point and widened by a column; the exact test follows per voxel.
ivec2 rowInterval(RasterTriangle t, RasterCell cell, int count)
{
    vec2 interval = vec2(0.0, float(count - 1));
    for (int i = 0; i < 3; ++i)
    {
        float value = float(cell.uv[i]);
        float step = -float(t.dv[i] * t.s_w);
        float crossing = -value / step;
        if (step > 0.0)
            interval.x = max(interval.x, crossing - 1.0);
        if (step < 0.0)
            interval.y = min(interval.y, crossing + 1.0);
        if (step == 0.0 && value < 0.0)
            interval.y = -1.0;
    }
    bool empty = !(interval.x <= interval.y);
    return empty ? ivec2(0, -1) : ivec2(floor(interval.x), ceil(interval.y));
}

void rasterizeRow(RasterTriangle t, Surface surface, ivec2 column, int column_last)
{
    RasterCell probe = startColumn(t, column);
    ivec2 interval = rowInterval(t, probe, column_last - column.x + 1);
    int last = min(column.x + interval.y, column_last);
    column.x += interval.x;
    RasterCell first = startColumn(t, column);
    RasterCell cell = first;
    BrickCursor cursor = noBrick();
    for (bool walking = column.x <= last; walking;)
    {
        if (isCovered(t, cell))
            emitFragment(t, surface, cornerWeights(t, cell), uvec3(voxelOf(t, column, cell.w)), cursor);
        if (kCoverage == kCoverageConservative && cell.w < min(cell.w_high, t.high.z))
        {
            moveLayers(t, 1, cell);
        }
        else
        {
            nextColumn(t, first);
            cell = first;
            column.x += 1;
            walking = column.x <= last;
        }
    }
}

// Every fourth tile of a band of four rows, from number strip on: the eight threads of a block share its two bands.
// column: the band's first one, both coordinates multiples of 4.
void rasterizeBand(RasterTriangle t, ivec2 column, int column_last, int strip)
{
    RasterCell probe = startColumn(t, column);
    probe.uv += max(EDGE_IVEC3(0), t.du * (EDGE_INT(3) * t.s_w)); // where one of the four rows is inside
    ivec2 interval = rowInterval(t, probe, column_last - column.x + 1);
    int last = min(column.x + interval.y, column_last);
    column.x += (interval.x & ~3) + 4 * strip;
    for (; column.x <= last; column.x += 16)
        setTile(t, coverTile(t, column));
}

void main()
{
    uint block_count = min(params.counters.data[0].block_count, params.block_capacity);
    uint group_count = (block_count * kBlockRows + kRowsGroup - 1u) / kRowsGroup;
    uint group = workgroupIndex();
    if (group >= group_count)
        return;
    uint thread = interleave(group, group_count) * kRowsGroup + gl_LocalInvocationIndex;
    uint block_number = thread / kBlockRows;
    if (block_number >= block_count)
        return;
    RowBlock block = params.row_blocks.data[block_number];
    if (block.triangle == kAbsent)
        return;
    BigTriangle big = params.big_triangles.data[block.triangle];
    Draw draw = params.scene.data[0].draws.data[big.draw];
    uvec3 vertices = params.scene.data[0].triangles.data[draw.first_triangle + big.triangle];

    i64vec3 a = i64vec3(big.v1 - big.v0);
    i64vec3 b = i64vec3(big.v2 - big.v0);
    i64vec3 normal = a.yzx * b.zxy - a.zxy * b.yzx;
    ivec3 low = ((min(big.v0, min(big.v1, big.v2)) + (kVoxelLattice - 1)) >> kVoxelLatticeLog2) - 1;
    ivec3 high = max(big.v0, max(big.v1, big.v2)) >> kVoxelLatticeLog2;
    low = max(low, ivec3(0));
    high = min(high, ivec3(int(params.resolution) - 1));
    RasterTriangle t = setupTriangle(big.v0, big.v1, big.v2, normal, majorAxis(normal, low, high), low, high,
                                     int(params.resolution));
    Surface surface = loadSurface(draw, vertices, vec3(normal), float(t.n_w));

    ivec2 corner = blockOrigin(t.low.xy) + ivec2((block.position >> 16) * kBlockColumns,
                                                 (block.position & 65535u) * kBlockRows);
    int column_last = min(corner.x + int(kBlockColumns) - 1, t.high.x);
    int lane = int(thread % kBlockRows);
    if (kCoverage == kCoverageThin && kMode == kModeCoverage && kClass != kClassAlpha)
        rasterizeBand(t, ivec2(corner.x, corner.y + (lane & ~3)), column_last, lane & 3);
    else if (corner.y + lane >= t.low.y && corner.y + lane <= t.high.y)
        rasterizeRow(t, surface, ivec2(max(corner.x, t.low.x), corner.y + lane), column_last);
}
