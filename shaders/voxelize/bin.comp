#version 460
// SPDX-License-Identifier: MIT
// Sorts triangles into bricks, a thread a triangle. Small ones go into all bricks that their box touches, mostly a
// single one. Large ones are listed for voxelize/bin_large, in blocks of columns of bricks.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BinParams, VOXELIZE_BIN_CONSTANTS);
layout(local_size_x = kChunkTriangles) in;

#define BRICKS_BINDING 0
#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/axes.glsl"
#include "voxelize/bin.glsl"
#include "voxelize/chunk.glsl"
#include "voxelize/dropped.glsl"
#include "voxelize/snap.glsl"

ivec3 extentOf(SnappedTriangle t)
{
    return max(t.v0, max(t.v1, t.v2)) - min(t.v0, min(t.v1, t.v2));
}

// Blocks are those of the projection along the major axis, row by row.
void listLarge(SnappedTriangle snapped, uint draw, uint triangle)
{
    uint axis = majorAxis(snapped.normal, snapped.low, snapped.high);
    ivec3 size = (snapped.high >> int(kBrickLog2)) - (snapped.low >> int(kBrickLog2)) + 1;
    uvec2 blocks = (uvec2(permuted(size, axis).xy) + (kBlockBricks - 1u)) / kBlockBricks;
    uint count = blocks.x * blocks.y;
    ivec3 extent = extentOf(snapped);
    if (max(extent.x, max(extent.y, extent.z)) > kTileExtent || count > kBlocksMax)
    {
        atomicAdd(params.counters.data[0].wide_count, 1u);
        return;
    }
    uint first = atomicAdd(params.counters.data[0].large_count, count);
    if (first > kRowBlocksMax)
        atomicMax(params.counters.data[0].wide_count, 1u); // before large_count wraps around
    for (uint block = 0u; block < count; ++block)
        if (first + block < params.large_capacity)
            params.large.data[first + block] = LargeBlock(draw, triangle, block);
}

// Whether the triangle is short, in the grid and beyond, and has few columns.
bool isSmall(SnappedTriangle t)
{
    ivec3 extent = extentOf(t);
    ivec3 size = t.high - t.low + 1;
    int least = min(size.x, min(size.y, size.z));
    int most = max(size.x, max(size.y, size.z));
    int middle = size.x + size.y + size.z - least - most;
    return max(extent.x, max(extent.y, extent.z)) <= kSmallExtent && most <= 1 << kBrickLog2 &&
           most * middle <= int(kItemColumns);
}

void takeTriangle(ChunkTriangle taken)
{
    uvec3 vertices = loadTriangle(taken.draw.first_triangle + taken.triangle);
    SnappedTriangle snapped = snapTriangle(taken.draw, vertices, true);
    bool kept = taken.exists && snapped.fate == kKept && all(lessThanEqual(snapped.low, snapped.high));
    bool small = isSmall(snapped);
    if (!kWrites && taken.exists)
    {
        countDropped(snapped.fate);
        if (kept && !small)
            listLarge(snapped, taken.draw_number, taken.triangle);
    }
    ivec3 low = snapped.low >> int(kBrickLog2);
    ivec3 high = snapped.high >> int(kBrickLog2);
    ivec3 brick = low;
    for (bool walking = kept && small; walking;)
    {
        uint place = takeItems(brickKey(uvec3(brick), brickLevel()), 1u);
        if (kWrites)
            writeItem(place, taken.draw_number, kWholeBox, taken.triangle);
        bool x_ends = brick.x == high.x;
        bool y_ends = x_ends && brick.y == high.y;
        walking = !y_ends || brick.z != high.z;
        brick = ivec3(x_ends ? low.x : brick.x + 1, y_ends ? low.y : (x_ends ? brick.y + 1 : brick.y),
                      y_ends ? brick.z + 1 : brick.z);
    }
}

// The last subgroup of a walk over chunks sizes voxelize/bin_large for what has been listed so far.
void sizeLarge(uint group_count)
{
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kChunkTriangles) && subgroupElect())
    {
        uint blocks = min(atomicOr(params.counters.data[0].large_count, 0u), params.large_capacity);
        params.counters.data[0].large = foldedArgs(largeGroups(blocks), kGroupsXMax);
        atomicExchange(params.counters.data[0].arrived, 0u);
    }
}

void main()
{
    ChunkTriangle taken = loadChunkTriangle();
    takeTriangle(taken);
    if (!kWrites && workgroupIndex() < chunkGroups())
        sizeLarge(chunkGroups());
}
