// SPDX-License-Identifier: MIT
// The columns of a triangle that an item stands for, and which of them the triangle covers.
// Needs GPU_ENTRY with params.setups, surfaces, items and window, and the constant kWideKeys.
#ifndef ZVO_SHADERS_VOXELIZE_ITEM_GLSL
#define ZVO_SHADERS_VOXELIZE_ITEM_GLSL

#include "voxelize/bricks.h"

const uint kCoverage = kCoverageThin;
const bool kThin = true;

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

// A large triangle whose box are the columns of a tile of a brick. brick: its first voxel.
RasterTriangle tileTriangle(uint tile, TriangleSetup setup, ivec3 brick)
{
    ivec3 low = brick;
    ivec3 high = brick + ((1 << kBrickLog2) - 1);
    clipToWindow(low, high);
    CellBox box = voxelBox(setup, low, high);
    ivec2 corner = (box.low.xy & ~((1 << kBrickLog2) - 1)) + 4 * ivec2(tile & 3u, tile >> 2);
    box.low.xy = max(box.low.xy, corner);
    box.high.xy = min(box.high.xy, corner + 3);
    return rasterTriangle(setup, box, gridResolution());
}

// The voxels in the columns of t's box, which may be empty.
ItemVoxels coverColumns(RasterTriangle t)
{
    ivec2 size = t.high.xy - t.low.xy + 1;
    uint width = uint(size.x);
    uint column_count = size.x > 0 && size.y > 0 ? uint(size.x * size.y) : 0u;
    ItemVoxels voxels = noVoxels(t);
    TileCell row = startTile(t, t.low.xy);
    TileCell cell = row;
    uint row_end = width;
    for (uint column = 0u; column < column_count;)
    {
        addVoxel(isCovered(t, cell), column, cell.w, voxels);
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
