// SPDX-License-Identifier: MIT
// Rasterizes big triangles in 64-bit integers, one thread for each row of at most kBlockColumns columns, or for tiles
// of the same block, which take 32 bits. Columns outside of the triangle's outline in the (u, v) projection are left
// out, so the work follows the rows that it really crosses.
#ifndef ZVO_SHADERS_VOXELIZE_ROWS_GLSL
#define ZVO_SHADERS_VOXELIZE_ROWS_GLSL

#include "voxelize/constants.glsl"

#define BRICKS_BINDING 0
#define COLOR_BINDING 15
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/big_triangle.glsl"
#include "voxelize/fragment.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/surface.glsl"
#include "voxelize/tile.glsl"

layout(local_size_x = kRowsGroup) in;

#ifdef BOUND
TEXELS_4(13, big_triangles);
TEXELS_2(14, row_blocks);

RowBlock loadRowBlock(uint i)
{
    uvec2 words = texelFetch(texels2_row_blocks, int(i)).xy;
    return RowBlock(words.x, words.y);
}

BigTriangle loadBigTriangle(uint i)
{
    uvec4 a = texelFetch(texels4_big_triangles, int(3u * i));
    uvec4 b = texelFetch(texels4_big_triangles, int(3u * i + 1u));
    uvec4 c = texelFetch(texels4_big_triangles, int(3u * i + 2u));
    return BigTriangle(ivec3(a.xyz), ivec3(a.w, b.xy), ivec3(b.zw, c.x), c.y, c.z, c.w);
}
#else
RowBlock loadRowBlock(uint i)
{
    return params.row_blocks.data[i];
}

BigTriangle loadBigTriangle(uint i)
{
    return params.big_triangles.data[i];
}
#endif

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
            moveUp(t, true, cell);
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
// column: the first one of these rows in the block, both coordinates multiples of 4. Where tiles are single columns,
// those of a leaf are taken one after the other.
void rasterizeTiles(RasterTriangle t, ivec2 column, int column_last, int lane)
{
    RasterCell probe = startColumn(t, column);
    ivec2 interval = wholeColumns(outlineColumns(t, probe, column_last - column.x + 1, 4));
    int last = min(column.x + interval.y, column_last);
    int extent = tileExtent(t);
    ivec2 tile = ivec2(column.x + (interval.x & ~3) + 4 * lane, column.y);
    for (; tile.x <= last;)
    {
        setTile(t, coverTile(t, tile, extent));
        tile.y += extent;
        bool row_ends = tile.y == column.y + 4;
        tile.y = row_ends ? column.y : tile.y;
        tile.x += row_ends ? extent : 0;
        tile.x += row_ends && (tile.x & 3) == 0 ? 12 : 0;
    }
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
    RowBlock block = loadRowBlock(block_number);
    BigTriangle big = loadBigTriangle(block.band);
    Draw draw = loadDraw(big.draw);
    uvec3 vertices = loadTriangle(draw.first_triangle + big.triangle);

    i64vec3 normal;
    RasterTriangle t = setupBigTriangle(big, normal);
    Surface surface = loadSurface(draw, vertices, vec3(normal), float(t.n_w));

    ivec2 corner = blockOrigin(t.low.xy) + ivec2(unpackBlock(block.position) * uvec2(kBlockColumns, kBlockRows));
    int column_last = min(corner.x + int(kBlockColumns) - 1, t.high.x);
    int lane = int(thread % kBlockRows);
    if (kThin && kMode == kModeCoverage && kMaterialClass != kClassAlpha)
        rasterizeTiles(t, ivec2(corner.x, corner.y + (lane & ~3)), column_last, lane & 3);
    else if (corner.y + lane >= t.low.y && corner.y + lane <= t.high.y)
        rasterizeRow(t, surface, ivec2(max(corner.x, t.low.x), corner.y + lane), column_last);
}

#endif
