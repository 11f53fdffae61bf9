// SPDX-License-Identifier: MIT
// Functions that the kernels over big triangles share.
// Needs EDGE_INT, EDGE_IVEC3 and EDGE_WIDE as voxelize/raster.glsl does, and params.window.
#ifndef ZVO_SHADERS_VOXELIZE_BIG_TRIANGLE_GLSL
#define ZVO_SHADERS_VOXELIZE_BIG_TRIANGLE_GLSL

#include "voxelize/raster.glsl"
#include "voxelize/voxelize.h"
#include "voxelize/window.glsl"

// RowBlock::position of a block in a column and a row of blocks: row | column << 16.
uint packBlock(uvec2 block)
{
    return block.y | (block.x << 16);
}

uvec2 unpackBlock(uint position)
{
    return uvec2(position >> 16, position & 65535u);
}

// normal: exact, of the lattice points.
RasterTriangle setupBigTriangle(BigTriangle big, out i64vec3 normal)
{
    ivec3 a = big.v1 - big.v0;
    ivec3 b = big.v2 - big.v0;
    normal = product(a.yzx, b.zxy) - product(a.zxy, b.yzx);
    ivec3 low = ((min(big.v0, min(big.v1, big.v2)) + (kVoxelLattice - 1)) >> kVoxelLatticeLog2) - 1;
    ivec3 high = max(big.v0, max(big.v1, big.v2)) >> kVoxelLatticeLog2;
    clipToWindow(low, high);
    return setupTriangle(big.v0, big.v1, big.v2, normal, majorAxis(normal, low, high), low, high, gridResolution());
}

// Shrinks an interval of columns to those with value + step * column >= 0, estimated in floating point, and widened by
// a column. Numbers of columns are below 2^18, so the estimate's error is a small part of a column.
void clipColumns(float value, float step, inout vec2 interval)
{
    float crossing = -value / step;
    if (step > 0.0)
        interval.x = max(interval.x, crossing - 1.0);
    if (step < 0.0)
        interval.y = min(interval.y, crossing + 1.0);
    if (step == 0.0 && value < 0.0)
        interval.y = -1.0;
}

// Columns that can lie inside the outline in the (u, v) projection, as offsets from the cell's column, in any of
// row_count rows from the cell's on: those for which each edge function, linear in both, is not negative in the row.
vec2 outlineColumns(RasterTriangle t, RasterCell cell, int column_count, int row_count)
{
    vec2 interval = vec2(0.0, float(column_count - 1));
    for (int i = 0; i < 3; ++i)
    {
        EDGE_INT rise = product(max(t.edge_u[i], 0), kVoxelLattice * (row_count - 1));
        clipColumns(float(cell.uv[i] + rise), -float(t.edge_v[i]) * float(kVoxelLattice), interval);
    }
    return interval;
}

// Columns whose layers can lie inside the grid. The plane rises by at most a layer for each column and row.
vec2 layerColumns(RasterTriangle t, RasterCell cell, vec2 interval, int row_count)
{
    const float margin = 3.0; // layers: a conservative column's range, and rounding
    float inverse = 1.0 / float(t.n_w);
    float slope = float(t.rise_u) * inverse;
    float by_rows = float(t.rise_v) * inverse * float(row_count - 1);
    float height = float(cell.w);
    if (t.n_w != 0)
    {
        clipColumns(height + by_rows - float(t.low.z) + margin, slope, interval);
        clipColumns(float(t.high.z) - height + margin, -slope, interval);
    }
    return interval;
}

// First and last column as whole numbers; last < first: none.
ivec2 wholeColumns(vec2 interval)
{
    bool empty = !(interval.x <= interval.y);
    return empty ? ivec2(0, -1) : ivec2(floor(interval.x), ceil(interval.y));
}

#endif
