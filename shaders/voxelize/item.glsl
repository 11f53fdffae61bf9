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
#include "lib/arithmetic.glsl"
#include "lib/brick_keys.glsl"
#include "lib/morton.glsl"
#include "voxelize/setup.glsl"
#include "voxelize/tile_walk.glsl"
#include "voxelize/window.glsl"

const uint kLayerBits = 4u; // of a layer's number in a brick

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

// The setup of the triangle of an item.
uint setupOf(BrickItem item)
{
    return item.triangle & ((1u << kItemTileShift) - 1u);
}

// A triangle whose box are the columns of an item. brick: its first voxel.
RasterTriangle itemTriangle(BrickItem item, TriangleSetup setup, ivec3 brick)
{
    ivec3 low = brick;
    ivec3 high = brick + ((1 << kBrickLog2) - 1);
    clipToWindow(low, high);
    CellBox box = voxelBox(setup, low, high);
    uint tile = item.triangle >> kItemTileShift;
    if (tile != kWholeBox)
    {
        ivec2 corner = (box.low.xy & ~((1 << kBrickLog2) - 1)) + 4 * ivec2(tile & 3u, tile >> 2);
        box.low.xy = max(box.low.xy, corner);
        box.high.xy = min(box.high.xy, corner + 3);
    }
    return rasterTriangle(setup, box, gridResolution());
}

const uint kColumnsMask = (1u << kItemColumns) - 1u;
const uint kWidthShift = 16u;
const uint kFirstUShift = 20u;
const uint kFirstVShift = 24u;
const uint kAxisShift = 28u;
const uint kMirrorUShift = 30u;
const uint kMirrorVShift = 31u;

// The voxels in the columns of t's box, which may be empty.
ItemVoxels coverItem(RasterTriangle t)
{
    ivec2 size = t.high.xy - t.low.xy + 1;
    uint width = uint(size.x);
    uint column_count = size.x > 0 && size.y > 0 ? uint(size.x * size.y) : 0u;
    uint columns = 0u;
    uvec2 layers = uvec2(0u);
    TileCell row = startTile(t, t.low.xy);
    TileCell cell = row;
    uint row_end = width;
    for (uint column = 0u; column < column_count;)
    {
        columns |= isCovered(t, cell) ? 1u << column : 0u;
        uint layer = (uint(cell.w) & 15u) << (kLayerBits * (column & 7u));
        layers |= column < 8u ? uvec2(layer, 0u) : uvec2(0u, layer);
        ++column;
        nextColumn(t, cell);
        if (column == row_end)
        {
            nextRow(t, row);
            cell = row;
            row_end += width;
        }
    }
    uvec2 first = uvec2(t.low.xy) & 15u;
    uint info = columns | (((width - 1u) & 15u) << kWidthShift) | (first.x << kFirstUShift) |
                (first.y << kFirstVShift) | (t.axis << kAxisShift) | uint(t.mirror.x & 1) << kMirrorUShift |
                uint(t.mirror.y & 1) << kMirrorVShift;
    return ItemVoxels(info, layers.x, layers.y);
}

// The number of a voxel in its brick: that of its leaf, and six bits of the cell in it. voxel: in the brick.
uint numberOf(uvec3 voxel)
{
    return (cellInBlock(voxel >> 2) << 6) | cellInBlock(voxel);
}

// The voxel in a column of an item: its place in the brick.
uvec3 voxelInColumn(ItemVoxels voxels, uint column)
{
    uint width = bitfieldExtract(voxels.info, int(kWidthShift), 4) + 1u;
    uint y = divideSmall(column, width);
    uint u = bitfieldExtract(voxels.info, int(kFirstUShift), 4) + column - y * width;
    uint v = bitfieldExtract(voxels.info, int(kFirstVShift), 4) + y;
    u ^= (voxels.info >> kMirrorUShift & 1u) != 0u ? 15u : 0u;
    v ^= (voxels.info >> kMirrorVShift) != 0u ? 15u : 0u;
    uint w = ((column < 8u ? voxels.layers_lo : voxels.layers_hi) >> (kLayerBits * (column & 7u))) & 15u;
    uint axis = bitfieldExtract(voxels.info, int(kAxisShift), 2);
    return uvec3(unpermuted(ivec3(u, v, w), axis));
}

// Takes the next voxel away from those of an item, which has one. Returns its place in the brick.
uvec3 takeVoxel(inout ItemVoxels voxels)
{
    uint column = uint(findLSB(voxels.info & kColumnsMask));
    uvec3 voxel = voxelInColumn(voxels, column);
    voxels.info &= ~(1u << column);
    return voxel;
}

bool hasVoxels(ItemVoxels voxels)
{
    return (voxels.info & kColumnsMask) != 0u;
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
