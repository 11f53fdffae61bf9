// SPDX-License-Identifier: MIT
// Snaps every triangle to the lattice. Small ones are rasterized here, one thread each, in 32-bit integers; big ones
// are listed in bands of rows for voxelize/bands and voxelize/rows. (After Schwarz and Seidel 2010; coverage:
// docs/voxelization.md.)
#ifndef ZVO_SHADERS_VOXELIZE_TRIANGLES_GLSL
#define ZVO_SHADERS_VOXELIZE_TRIANGLES_GLSL

#include "voxelize/constants.glsl"

#define BRICKS_BINDING 0
#define COLOR_BINDING 15
#define EDGE_INT int
#define EDGE_IVEC3 ivec3
#include "lib/arithmetic.glsl"
#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/chunk.glsl"
#include "voxelize/dropped.glsl"
#include "voxelize/fragment.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/surface.glsl"
#include "voxelize/snap.glsl"

layout(local_size_x = kChunkTriangles) in;

void listBigTriangle(SnappedTriangle snapped, RasterTriangle t, uint draw, uint triangle)
{
    uint row_count = uint(t.high.y - blockOrigin(t.low.xy).y + 1);
    const uint band_rows = kBandStrips * kBlockRows;
    uint count = (row_count + band_rows - 1u) / band_rows;
    uint first = atomicAdd(params.counters.data[0].big_count, count);
    if (first > kRowBlocksMax) // a band has a row block or more
        atomicMax(params.counters.data[0].blocks_exceeded, 1u);
    for (uint band = 0u; band < count; ++band)
        if (first + band < params.big_capacity)
            params.big_triangles.data[first + band] =
                BigTriangle(snapped.v0, snapped.v1, snapped.v2, draw, triangle, band);
}

// Thin coverage, with at most one voxel a column: the covered columns. Bit i: column i of the bounding box, row by row.
uint coveredColumns(RasterTriangle t, uvec2 extent)
{
    uint covered = 0u;
    uint column = 0u;
    uint column_count = extent.x * extent.y;
    uint row_end = extent.x;
    RasterCell row = startColumn(t, t.low.xy);
    RasterCell cell = row;
    for (; column < column_count;)
    {
        covered |= isCovered(t, cell) ? 1u << column : 0u;
        ++column;
        nextColumn(t, cell);
        if (column == row_end)
        {
            nextRow(t, row);
            cell = row;
            row_end += extent.x;
        }
    }
    return covered;
}

// The voxels of thin coverage are those of the covered columns alone: on devices that do not skip branches, an empty
// column is then as cheap as its test, while a fragment is expensive. Those of conservative coverage are found in a walk
// over all layers of all columns of the bounding box. Both are one loop, as fragments are most of the kernel's code.
void rasterize(RasterTriangle t, Surface surface, uvec2 extent, bool selected)
{
    uint covered = kThin && selected ? coveredColumns(t, extent) : 0u;
    ivec2 column = t.low.xy;
    RasterCell cell = startColumn(t, column);
    RasterCell row = cell;
    RasterCell first = cell; // the column's lowest layer
    BrickCursor cursor = noBrick();
    for (bool walking = kThin ? covered != 0u : selected; walking;)
    {
        if (kThin)
        {
            uint number = uint(findLSB(covered));
            uint y = divideSmall(number, extent.x);
            column = t.low.xy + ivec2(number - y * extent.x, y);
            cell = startColumn(t, column);
        }
        if (kThin || isCovered(t, cell))
            emitFragment(t, surface, cornerWeights(t, cell), uvec3(voxelOf(t, column, cell.w)), cursor);
        if (kThin)
        {
            covered &= covered - 1u;
            walking = covered != 0u;
        }
        else if (cell.w < min(cell.w_high, t.high.z))
        {
            moveUp(t, true, cell);
        }
        else
        {
            bool row_ends = column.x == t.high.x;
            if (row_ends)
                nextRow(t, row);
            else
                nextColumn(t, first);
            if (row_ends)
                first = row;
            cell = first;
            column = row_ends ? ivec2(t.low.x, column.y + 1) : ivec2(column.x + 1, column.y);
            walking = column.y <= t.high.y;
        }
    }
}

void takeTriangle(uint draw_number, Draw draw, uint triangle)
{
    uvec3 vertices = loadTriangle(draw.first_triangle + triangle);
    SnappedTriangle snapped = snapTriangle(draw, vertices, kThin);
    uint axis = majorAxis(snapped.normal, snapped.low, snapped.high);
    RasterTriangle t = setupTriangle(snapped.v0, snapped.v1, snapped.v2, snapped.normal, axis, snapped.low,
                                     snapped.high, gridResolution());
    uvec2 extent = uvec2(t.high.xy - t.low.xy + 1);
    ivec3 size = max(snapped.v0, max(snapped.v1, snapped.v2)) - min(snapped.v0, min(snapped.v1, snapped.v2));
    bool small = max(size.x, max(size.y, size.z)) <= kSmallExtent && extent.x * extent.y <= kSmallColumns;
    bool kept = snapped.fate == kKept && all(lessThanEqual(snapped.low, snapped.high));
    if (kMode == kModeCoverage)
    {
        countDropped(snapped.fate);
        if (kept && !small)
            listBigTriangle(snapped, t, draw_number, triangle);
    }
    Surface surface = loadSurface(draw, vertices, vec3(snapped.normal), float(t.n_w));
    rasterize(t, surface, extent, kept && small);
}

// The last subgroup of a walk over chunks sizes voxelize/bands for what has been listed so far.
void sizeBands(uint group_count)
{
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kChunkTriangles) && subgroupElect())
    {
        uint bands = min(atomicOr(params.counters.data[0].big_count, 0u), params.big_capacity);
        params.counters.data[0].bands = foldedArgs(bandGroups(bands), kGroupsXMax);
        atomicExchange(params.counters.data[0].arrived, 0u);
    }
}

void main()
{
    ChunkTriangle taken = loadChunkTriangle();
    if (taken.exists)
        takeTriangle(taken.draw_number, taken.draw, taken.triangle);
    if (kMode == kModeCoverage && workgroupIndex() < chunkGroups())
        sizeBands(chunkGroups());
}

#endif
