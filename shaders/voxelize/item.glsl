// SPDX-License-Identifier: MIT
// The columns of a triangle that an item stands for, and which of them the triangle covers.
// Needs GPU_ENTRY with params.setups, items and window, and the constants kWideKeys, kCoverage and kEmits.
#ifndef ZVO_SHADERS_VOXELIZE_ITEM_GLSL
#define ZVO_SHADERS_VOXELIZE_ITEM_GLSL

#include "voxelize/bricks.h"

const bool kThin = kCoverage == kCoverageThin;

#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#define SETUPS_BINDING 17
#include "lib/brick_keys.glsl"
#include "voxelize/item_voxels.glsl"
#include "voxelize/setup.glsl"
#include "voxelize/tile_walk.glsl"
#include "voxelize/window.glsl"

#ifdef BOUND
TEXELS_2(13, items);

BrickItem loadItem(uint i)
{
    uvec2 words = texelFetch(texels2_items, int(i)).xy;
    return BrickItem(words.x, words.y);
}
#else
BrickItem loadItem(uint i)
{
    return params.items.data[i];
}
#endif

// A triangle whose box are the columns that an item's info tells (voxelize/bricks.h). brick: its first voxel.
RasterTriangle itemTriangle(uint info, TriangleSetup setup, ivec3 brick)
{
    ivec3 low = brick;
    ivec3 high = brick + ((1 << kBrickLog2) - 1);
    clipToWindow(low, high);
    CellBox box = voxelBox(setup, low, high);
    if (info != kWholeBox)
    {
        uint tile = info & 15u;
        uint column = info >> kItemColumnShift & 15u;
        bool is_tile = (info & kOneColumn) == 0u;
        ivec2 corner = (box.low.xy & ~((1 << kBrickLog2) - 1)) + 4 * ivec2(tile & 3u, tile >> 2) +
                       ivec2(column & 3u, column >> 2);
        box.low.xy = max(box.low.xy, corner);
        box.high.xy = min(box.high.xy, corner + (is_tile ? 3 : 0));
    }
    return rasterTriangle(setup, box, gridResolution());
}

// Columns of t's box, which may be empty.
uint columnCount(RasterTriangle t)
{
    ivec2 size = t.high.xy - t.low.xy + 1;
    return size.x > 0 && size.y > 0 ? uint(size.x * size.y) : 0u;
}

// The columns of t's box that thin coverage covers.
Voxels coverThin(RasterTriangle t)
{
    Voxels voxels = noVoxels(t);
    uint width = uint(t.high.x - t.low.x + 1);
    uint end = columnCount(t);
    uint row_end = width;
    TileCell row = startTile(t, t.low.xy);
    TileCell cell = row;
    for (uint column = 0u; column < end;)
    {
        bool covered = isCovered(t, cell);
        voxels.info |= covered ? 1u << column : 0u;
        voxels.layers |= layerOfColumn(column, covered ? cell.w : 0);
        ++column;
        nextColumn(t, cell);
        if (column == row_end)
        {
            nextRow(t, row);
            cell = row;
            row_end += width;
        }
    }
    return voxels;
}

// The layers of each column of t's box that conservative coverage covers: they stand one above the other.
Voxels coverConservative(RasterTriangle t)
{
    Voxels voxels = noVoxels(t);
    uint width = uint(t.high.x - t.low.x + 1);
    uint end = columnCount(t);
    uint row_end = width;
    RasterCell row = startColumn(t, t.low.xy);
    RasterCell first = row; // the column's lowest layer
    RasterCell cell = row;
    for (uint column = 0u; column < end;)
    {
        if (isCovered(t, cell))
        {
            bool is_first = (voxels.info >> column & 1u) == 0u;
            voxels.info |= 1u << column;
            voxels.layers |= layerOfColumn(column, is_first ? cell.w : 0);
            voxels.last_layers &= ~layerOfColumn(column, 15);
            voxels.last_layers |= layerOfColumn(column, cell.w);
        }
        if (cell.w < min(cell.w_high, t.high.z))
        {
            moveUp(t, true, cell);
        }
        else
        {
            ++column;
            bool row_ends = column == row_end;
            if (row_ends)
                nextRow(t, row);
            else
                nextColumn(t, first);
            if (row_ends)
                first = row;
            cell = first;
            row_end += row_ends ? width : 0u;
        }
    }
    return voxels;
}

Voxels coverColumns(RasterTriangle t)
{
    return kThin ? coverThin(t) : coverConservative(t);
}

// The barycentric edge functions of a triangle over the column of a voxel: component i belongs to vertex i.
i64vec3 cornersAt(TriangleSetup setup, ivec3 voxel)
{
    ivec2 column = permuted(voxel, setup.flags & kSetupAxis).xy ^ mirrorOf(setup);
    ivec3 to_u = column.x * kVoxelLattice + kVoxelLattice / 2 - setup.u;
    ivec3 to_v = column.y * kVoxelLattice + kVoxelLattice / 2 - setup.v;
    i64vec3 corners = (product(setup.u.yzx - setup.u, to_v) - product(setup.v.yzx - setup.v, to_u)).yzx;
    return hasFlag(setup, kSetupExchanged) ? corners.xzy : corners;
}

// The first voxel of a brick.
ivec3 brickCorner(BrickEntry brick)
{
    return ivec3(brickCell(keyOf(brick), brickLevel())) << int(kBrickLog2);
}

#endif
