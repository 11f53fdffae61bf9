#version 460
// SPDX-License-Identifier: MIT
// Makes the items of large triangles, kBlockLanes threads a block of them. A block is walked in parts of 8^2 columns of
// bricks, of which each thread takes every kBlockLanes-th column; blocks and parts that the triangle's outline or plane
// does not reach end at once, so that the work is that of the triangle, not of its box. The test of a brick is exact
// and conservative: that of voxels, at the scale of bricks. In a brick, tiles of columns that the triangle's outline or
// plane does not reach get no item.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BinLargeParams, VOXELIZE_BIN_LARGE_CONSTANTS);
layout(local_size_x = kLargeGroup) in;

const uint kCoverage = kCoverageConservative; // of bricks
const bool kThin = false;
const bool kEmits = false;
const uint kVoxelsStride = kItemCoverage == kCoverageThin ? 1u : 2u;

#define BRICKS_BINDING 0
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#define RASTER_CELL_LOG2 kBrickLatticeLog2
#define SETUPS_BINDING 17
#include "voxelize/bin.glsl"
#include "lib/arithmetic.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/setup.glsl"

const float kRounding = 1.0 / float(1 << 28); // layers a lattice unit: four times the last bit of a float

// Which of the 4x4 tiles of a brick the triangle may have voxels in, bit u + 4 v. cell: the walk's state at the brick.
// voxels: of the triangle, inside the grid.
uint tilesOf(RasterTriangle t, RasterCell cell, ivec2 column, CellBox voxels)
{
    const int tile_units = kCell / 4;
    const int half_tile = tile_units / 2;
    ivec2 corner = column << int(kBrickLog2);
    ivec2 low = max(voxels.low.xy - corner, ivec2(0)) >> 2;
    ivec2 high = min(voxels.high.xy - corner, ivec2((1 << kBrickLog2) - 1)) >> 2;
    // Edge functions at the first tile's centre, with the support of a tile.
    const int first = half_tile - kCell / 2;
    i64vec3 support = i64vec3(abs(t.edge_u)) + i64vec3(abs(t.edge_v));
    i64vec3 row = cell.uv - support * int64_t(kCell / 2 - half_tile) + product(t.edge_u, ivec3(first)) -
                  product(t.edge_v, ivec3(first));
    bool flat_out = t.n_w == 0; // a segment or a point: the plane test passes
    float inverse = flat_out ? 0.0 : 1.0 / float(t.n_w);
    precise vec2 slope = vec2(float(t.rise_u), float(t.rise_v)) * inverse; // layers a column
    ivec2 to_first = corner * kVoxelLattice + half_tile - ivec2(t.u.x, t.v.x);
    precise vec2 rise = slope * vec2(to_first);
    precise float height = float(t.w.x - ((cell.w << int(kBrickLog2)) * kVoxelLattice)) + rise.x;
    height = (height + rise.y) * (1.0 / float(kVoxelLattice));
    precise float reach = 2.0 * slope.x;
    reach = reach + 2.0 * slope.y;
    reach = reach + 2.0; // half a tile, and rounding
    reach = reach + kRounding * (abs(float(t.w.x)) + abs(rise.x) + abs(rise.y));
    reach = flat_out ? float(kLatticeLimit) : reach;
    uint tiles = 0u;
    for (int v = 0; v < 4; ++v)
    {
        i64vec3 edge = row;
        for (int u = 0; u < 4; ++u)
        {
            precise vec2 step = slope * vec2(4 * u, 4 * v);
            precise float layer = height + step.x;
            layer = layer + step.y;
            bool inside = u >= low.x && u <= high.x && v >= low.y && v <= high.y && (edge.x | edge.y | edge.z) >= 0l &&
                          layer >= -reach && layer <= float(1 << kBrickLog2) + reach;
            tiles |= inside ? 1u << (u + 4 * v) : 0u;
            edge -= product(t.edge_v, ivec3(tile_units));
        }
        row += product(t.edge_u, ivec3(tile_units));
    }
    return tiles;
}

// Whether a triangle is small enough for a walk over several columns (voxelize/tile_walk.glsl).
bool areColumnsWalked(RasterTriangle t)
{
    ivec3 edges = max(abs(t.edge_u), max(abs(t.edge_v), abs(t.edge_w)));
    return max(edges.x, max(edges.y, edges.z)) <= kTileExtent;
}

// Writes the items of a tile, from place on: one, or where columns are not walked, one a column. Returns the next place.
uint writeTile(uint place, uint triangle, uint entry, uint tile, bool are_walked)
{
    if (are_walked)
        writeItem(place, BrickItem(triangle, entry), ItemVoxels(tile, 0u, 0u));
    else // no loop: software devices bound the iterations of all loops of a thread
        [[unroll]] for (uint column = 0u; column < kItemColumns; ++column)
            writeItem(place + column, BrickItem(triangle, entry),
                      ItemVoxels(tile | kOneColumn | (column << kItemColumnShift), 0u, 0u));
    return place + (are_walked ? 1u : kItemColumns);
}

// Whether the triangle may touch bricks of these columns: in floats, which round coordinates and products by less than
// the eighth of a brick at each side, and the half of one above and below, that are to spare.
bool mayTouch(RasterTriangle t, ivec2 first, uvec2 size)
{
    vec2 reach = float(kCell) * (0.5 * vec2(size) + 0.125);
    vec2 centre = float(kCell) * (vec2(first) + 0.5 * vec2(size));
    vec3 edge_u = vec3(t.edge_u);
    vec3 edge_v = vec3(t.edge_v);
    vec3 outline = edge_u * (centre.y - vec3(t.v)) - edge_v * (centre.x - vec3(t.u)) + abs(edge_u) * reach.y +
                   abs(edge_v) * reach.x;
    vec2 slope = vec2(float(t.rise_u), float(t.rise_v)) * (1.0 / float(max(t.n_w, 1l)));
    float layer = (float(t.w.x) + dot(slope, centre - vec2(t.u.x, t.v.x))) * (1.0 / float(kCell));
    float layers = dot(slope, reach) * (1.0 / float(kCell)) + 1.5;
    bool plane = t.n_w == 0 || (layer - layers <= float(t.high.z) && layer + layers >= float(t.low.z));
    return min(outline.x, min(outline.y, outline.z)) >= 0.0 && plane;
}

// The layers near a segment (n_w == 0) over a column. Those of its box would be too many.
ivec2 layersOfSegment(RasterTriangle t, ivec2 column)
{
    bool is_u = max(abs(t.edge_u.x), abs(t.edge_u.y)) >= max(abs(t.edge_v.x), abs(t.edge_v.y));
    ivec3 along = is_u ? t.edge_u : t.edge_v;
    bool is_first = abs(along.x) >= abs(along.y); // either is half of the segment, or more
    int length = is_first ? along.x : along.y;
    int rise = is_first ? t.edge_w.x : t.edge_w.y;
    ivec3 start = is_first ? ivec3(t.u.x, t.v.x, t.w.x) : ivec3(t.u.y, t.v.y, t.w.y);
    float from_start = float(kCell) * (float(is_u ? column.x : column.y) + 0.5) - float(is_u ? start.x : start.y);
    float slope = length == 0 ? float(kLatticeLimit) : float(rise) / float(length);
    float layer = (float(start.z) + slope * from_start) * (1.0 / float(kCell));
    float reach = 0.5 * abs(slope) + 2.0; // half a column, and more than rounding takes
    return ivec2(clamp(vec2(layer - reach, layer + reach), float(t.low.z), float(t.high.z)));
}

void binColumn(RasterTriangle t, ivec2 column, CellBox voxels, LargeBlock large)
{
    if (kItemCoverage == kCoverageConservative && t.n_w == 0)
    {
        ivec2 layers = layersOfSegment(t, column);
        t.low.z = layers.x;
        t.high.z = layers.y;
    }
    RasterCell cell = startColumn(t, column);
    int high = min(cell.w_high, t.high.z);
    for (bool walking = true; walking;)
    {
        if (isCovered(t, cell))
        {
            uint tiles = tilesOf(t, cell, column, voxels);
            if (tiles != 0u)
            {
                uint entry = brickEntry(brickKey(uvec3(voxelOf(t, column, cell.w)), brickLevel()));
                uint count = bitCount(tiles) * (areColumnsWalked(t) ? 1u : kItemColumns);
                uint place = addItems(count);
                for (; tiles != 0u; tiles &= tiles - 1u)
                    place = writeTile(place, large.triangle, entry, uint(findLSB(tiles)), areColumnsWalked(t));
            }
        }
        walking = cell.w < high;
        moveUp(t, walking, cell);
    }
}

// The walk of a thread over the columns of bricks of a block, part by part.
struct BlockWalk
{
    ivec2 first; // column of the block
    uvec2 size;  // its columns along u and v
    uvec2 parts; // its parts
    uint part_count;
    uint part;         // the next one
    uint lane;         // of the threads that share the block
    ivec2 corner;      // of the part before the next one, in the block
    uvec2 columns;     // of that part
    uint column_count; // 0: the triangle does not touch it
    uint next;         // of its columns
};

BlockWalk startBlock(RasterTriangle t, uint block, uint lane)
{
    uint number = bitfieldExtract(block, 0, int(kBlockLog2Shift));
    uint log2 = block >> kBlockLog2Shift;
    uint row_blocks = (uint(t.high.x - t.low.x) >> log2) + 1u;
    BlockWalk walk;
    walk.first = t.low.xy + ivec2(uvec2(number % row_blocks, number / row_blocks) << log2);
    walk.size = min(uvec2(t.high.xy - walk.first + 1), uvec2(1u << log2));
    walk.parts = ((walk.size - 1u) >> kBlockBricksLog2) + 1u;
    walk.part_count = mayTouch(t, walk.first, walk.size) ? walk.parts.x * walk.parts.y : 0u;
    walk.part = 0u;
    walk.lane = lane;
    walk.corner = ivec2(0);
    walk.columns = uvec2(1u);
    walk.column_count = 0u;
    walk.next = 0u;
    return walk;
}

bool isAtEnd(BlockWalk walk)
{
    return walk.next >= walk.column_count && walk.part >= walk.part_count;
}

// A step of a walk that is not at its end: to the part's next column or, after its last one, to the next part. Returns
// whether it is a column that may have bricks.
bool stepInBlock(RasterTriangle t, inout BlockWalk walk, out ivec2 column)
{
    bool is_column = walk.next < walk.column_count;
    uint row = is_column ? divideSmall(walk.next, walk.columns.x) : divideSmall(walk.part, walk.parts.x);
    ivec2 place = is_column ? walk.corner + ivec2(walk.next - row * walk.columns.x, row)
                            : ivec2(walk.part - row * walk.parts.x, row) << int(kBlockBricksLog2);
    uvec2 extent = is_column ? uvec2(1u) : min(walk.size - uvec2(place), uvec2(1u << kBlockBricksLog2));
    column = walk.first + place;
    bool touches = mayTouch(t, column, extent);
    walk.next = is_column ? walk.next + kBlockLanes : walk.lane;
    if (!is_column)
    {
        walk.corner = place;
        walk.columns = extent;
        walk.column_count = touches ? extent.x * extent.y : 0u;
        ++walk.part;
    }
    return is_column && touches;
}

// Threads look for a column that may have bricks, each its own, and then take theirs together.
void walkBlock(RasterTriangle t, CellBox voxels, LargeBlock large, BlockWalk walk)
{
    for (bool walking = !isAtEnd(walk); walking;)
    {
        bool found = false;
        ivec2 column = ivec2(0);
        for (bool searching = true; searching;)
        {
            found = stepInBlock(t, walk, column);
            walking = !isAtEnd(walk);
            searching = !found && walking;
        }
        if (found)
            binColumn(t, column, voxels, large);
    }
}

// The voxels of a triangle inside of the window.
CellBox voxelsOf(TriangleSetup setup)
{
    ivec3 low = ivec3(0);
    ivec3 high = ivec3(gridResolution() - 1);
    clipToWindow(low, high);
    return voxelBox(setup, low, high);
}

void main()
{
    uint block_count = min(params.counters.data[0].large_count, params.large_capacity);
    uint group_count = largeGroups(block_count);
    if (workgroupIndex() >= group_count)
        return;
    uint thread = interleave(workgroupIndex(), group_count) * kLargeGroup + gl_LocalInvocationIndex;
    if (thread / kBlockLanes >= block_count)
        return;
    LargeBlock large = params.large.data[thread / kBlockLanes];
    if (large.triangle >= params.setup_capacity)
        return; // it has no setup: this run is thrown away
    TriangleSetup setup = loadSetup(large.triangle);
    CellBox voxels = voxelsOf(setup);
    CellBox bricks = CellBox(voxels.low >> int(kBrickLog2), voxels.high >> int(kBrickLog2));
    RasterTriangle t = rasterTriangle(setup, bricks, gridResolution() >> int(kBrickLog2));
    walkBlock(t, voxels, large, startBlock(t, large.block, thread % kBlockLanes));
}
