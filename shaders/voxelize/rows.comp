#version 460
// SPDX-License-Identifier: MIT
// Rasterizes big triangles in 64-bit integers, one thread for each row of at most kBlockColumns columns, or for tiles
// of the same block. Columns outside of the triangle's outline in the (u, v) projection are left out, so the work
// follows the rows that it really crosses.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/constants.glsl"
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#define BRICKS_CONSTANT_ID 4
#include "lib/bricks.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/window.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/big_triangle.glsl"
#include "voxelize/shading.glsl"
#include "voxelize/vertex.glsl"
#include "voxelize/surface.glsl"
#include "voxelize/fragment.glsl"
#include "voxelize/tile.glsl"

layout(local_size_x = kRowsGroup) in;

void rasterizeRow(RasterTriangle t, Surface surface, ivec2 column, int column_last)
{
    RasterCell probe = startColumn(t, column);
    ivec2 interval = wholeColumns(outlineColumns(t, probe, column_last - column.x + 1, 1));
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

// Every fourth tile of four rows, from number lane on: the eight threads of a block share its two rows of tiles.
// column: the first one of these rows in the block, both coordinates multiples of 4.
void rasterizeTiles(RasterTriangle t, ivec2 column, int column_last, int lane)
{
    RasterCell probe = startColumn(t, column);
    ivec2 interval = wholeColumns(outlineColumns(t, probe, column_last - column.x + 1, 4));
    int last = min(column.x + interval.y, column_last);
    column.x += (interval.x & ~3) + 4 * lane;
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
    BigTriangle big = params.big_triangles.data[block.band];
    Draw draw = params.scene.data[0].draws.data[big.draw];
    uvec3 vertices = params.scene.data[0].triangles.data[draw.first_triangle + big.triangle];

    i64vec3 normal;
    RasterTriangle t = setupBigTriangle(big, normal);
    Surface surface = loadSurface(draw, vertices, vec3(normal), float(t.n_w));

    ivec2 corner = blockOrigin(t.low.xy) + ivec2(unpackBlock(block.position) * uvec2(kBlockColumns, kBlockRows));
    int column_last = min(corner.x + int(kBlockColumns) - 1, t.high.x);
    int lane = int(thread % kBlockRows);
    if (kCoverage == kCoverageThin && kMode == kModeCoverage && kMaterialClass != kClassAlpha)
        rasterizeTiles(t, ivec2(corner.x, corner.y + (lane & ~3)), column_last, lane & 3);
    else if (corner.y + lane >= t.low.y && corner.y + lane <= t.high.y)
        rasterizeRow(t, surface, ivec2(max(corner.x, t.low.x), corner.y + lane), column_last);
}
