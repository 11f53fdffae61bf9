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
#include "voxelize/fragment.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/shading.glsl"
#include "voxelize/vertex.glsl"
#include "voxelize/window.glsl"

layout(local_size_x = kChunkTriangles) in;

// Reasons to leave a triangle out.
const uint kKept = 0u;
const uint kNonfinite = 1u;
const uint kOutOfRange = 2u;
const uint kOutside = 3u;
const uint kZeroArea = 4u;

struct SnappedTriangle
{
    ivec3 v0;
    ivec3 v1;
    ivec3 v2;
    i64vec3 normal;
    ivec3 low; // touched voxels, inside the window
    ivec3 high;
    uint fate;
};

SnappedTriangle snapTriangle(Draw draw, uvec3 vertices)
{
    vec3 p0 = worldPosition(draw, vertices.x);
    vec3 p1 = worldPosition(draw, vertices.y);
    vec3 p2 = worldPosition(draw, vertices.z);
    vec3 q0 = latticePosition(p0);
    vec3 q1 = latticePosition(p1);
    vec3 q2 = latticePosition(p2);
    bool finite = isFinite(p0) && isFinite(p1) && isFinite(p2);
    bool in_range = finite && onLattice(q0) && onLattice(q1) && onLattice(q2);

    SnappedTriangle t;
    t.v0 = in_range ? ivec3(q0) : ivec3(0);
    t.v1 = in_range ? ivec3(q1) : ivec3(0);
    t.v2 = in_range ? ivec3(q2) : ivec3(0);
    i64vec3 a = i64vec3(t.v1 - t.v0);
    i64vec3 b = i64vec3(t.v2 - t.v0);
    t.normal = a.yzx * b.zxy - a.zxy * b.yzx;
    // A closed range [min, max] touches the closed voxels from ceil(min / 256) - 1 to floor(max / 256).
    ivec3 low = ((min(t.v0, min(t.v1, t.v2)) + (kVoxelLattice - 1)) >> kVoxelLatticeLog2) - 1;
    ivec3 high = max(t.v0, max(t.v1, t.v2)) >> kVoxelLatticeLog2;
    bool outside = any(lessThan(high, ivec3(0))) || any(greaterThanEqual(low, ivec3(gridResolution())));
    t.low = low;
    t.high = high;
    clipToWindow(t.low, t.high);
    bool flat_out = kThin && t.normal == i64vec3(0);
    t.fate = !finite ? kNonfinite : (!in_range ? kOutOfRange : (outside ? kOutside : (flat_out ? kZeroArea : kKept)));
    return t;
}

void countDropped(uint fate)
{
    if (fate == kNonfinite)
        atomicAdd(params.counters.data[0].nonfinite, 1u);
    if (fate == kOutOfRange)
        atomicAdd(params.counters.data[0].out_of_range, 1u);
    if (fate == kOutside)
        atomicAdd(params.counters.data[0].outside, 1u);
    if (fate == kZeroArea)
        atomicAdd(params.counters.data[0].zero_area, 1u);
}

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
    SnappedTriangle snapped = snapTriangle(draw, vertices);
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

Chunk loadChunk(uint number)
{
    uint64_t_ConstPtr chunks = uint64_t_ConstPtr(uint64_t(params.chunks)); // one load, not two
    uvec2 words = unpackUint2x32(chunks.data[number]);
    return Chunk(words.x, words.y);
}

// No thread returns early: lavapipe loads for one thread what is uniform, but only where all threads are active.
void main()
{
    uint group_count = kSingle ? (params.chunk_count + kChunkTriangles - 1u) / kChunkTriangles : params.chunk_count;
    bool is_group = workgroupIndex() < group_count;
    uint number = interleave(min(workgroupIndex(), group_count - 1u), group_count);
    if (kSingle)
        number = number * kChunkTriangles + gl_LocalInvocationIndex;
    bool is_chunk = is_group && number < params.chunk_count;
    Chunk chunk = loadChunk(min(number, params.chunk_count - 1u));
    uint triangle = chunk.first_triangle + (kSingle ? 0u : gl_LocalInvocationIndex);
    Draw draw = loadDraw(chunk.draw);
    if (is_chunk && triangle < draw.triangle_count)
        takeTriangle(chunk.draw, draw, triangle);
    if (kMode == kModeCoverage && is_group)
        sizeBands(group_count);
}

#endif
