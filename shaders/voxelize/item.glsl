// SPDX-License-Identifier: MIT
// The columns of a triangle that an item stands for, and which of them the triangle covers.
// Needs GPU_ENTRY with params.scene, items, origin, lattice_scale and window, and the constant kWideKeys.
#ifndef ZVO_SHADERS_VOXELIZE_ITEM_GLSL
#define ZVO_SHADERS_VOXELIZE_ITEM_GLSL

#include "voxelize/bricks.h"

const uint kCoverage = kCoverageThin;
const bool kThin = true;

#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#include "lib/brick_keys.glsl"
#include "lib/morton.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/snap.glsl"
#include "voxelize/tile_walk.glsl"
#include "voxelize/window.glsl"

const uint kLayerBits = 4u; // of a layer's number in a brick

// A triangle whose box are the item's columns.
struct ItemTriangle
{
    Draw draw;
    uvec3 vertices;
    i64vec3 normal;
    RasterTriangle t;
};

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

// brick: its first voxel.
ItemTriangle loadTriangle(BrickItem item, ivec3 brick)
{
    ItemTriangle result;
    uint tile = item.draw >> kItemTileShift;
    result.draw = loadDraw(item.draw & ((1u << kItemTileShift) - 1u));
    result.vertices = loadTriangle(result.draw.first_triangle + item.triangle);
    SnappedTriangle snapped = snapTriangle(result.draw, result.vertices, true);
    result.normal = snapped.normal;
    uint axis = majorAxis(snapped.normal, snapped.low, snapped.high);
    ivec3 low = max(snapped.low, brick);
    ivec3 high = min(snapped.high, brick + ((1 << kBrickLog2) - 1));
    result.t = setupTriangle(snapped.v0, snapped.v1, snapped.v2, snapped.normal, axis, low, high, gridResolution());
    if (tile != kWholeBox)
    {
        ivec2 corner = (result.t.low.xy & ~((1 << kBrickLog2) - 1)) + 4 * ivec2(tile & 3u, tile >> 2);
        result.t.low.xy = max(result.t.low.xy, corner);
        result.t.high.xy = min(result.t.high.xy, corner + 3);
    }
    return result;
}

const uint kColumnsMask = (1u << kItemColumns) - 1u;
const uint kWidthShift = 16u;
const uint kFirstUShift = 20u;
const uint kFirstVShift = 24u;
const uint kAxisShift = 28u;
const uint kMirrorUShift = 30u;
const uint kMirrorVShift = 31u;

// Of an item that may have no columns at all.
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

// Takes the next voxel away from those of an item, which has one. Returns its place in the brick.
uvec3 takeVoxel(inout ItemVoxels voxels)
{
    uint column = uint(findLSB(voxels.info & kColumnsMask));
    voxels.info &= ~(1u << column);
    uint width = bitfieldExtract(voxels.info, int(kWidthShift), 4) + 1u;
    uint y = divideSmall(column, width);
    uint u = bitfieldExtract(voxels.info, int(kFirstUShift), 4) + column - y * width;
    uint v = bitfieldExtract(voxels.info, int(kFirstVShift), 4) + y;
    u ^= (voxels.info >> kMirrorUShift & 1u) != 0u ? 15u : 0u;
    v ^= (voxels.info >> kMirrorVShift) != 0u ? 15u : 0u;
    uint w = ((column < 8u ? voxels.layers_lo : voxels.layers_hi) >> (kLayerBits * (column & 7u))) & 15u;
    uint axis = bitfieldExtract(voxels.info, int(kAxisShift), 2);
    return axis == 0u ? uvec3(w, u, v) : (axis == 1u ? uvec3(v, w, u) : uvec3(u, v, w));
}

bool hasVoxels(ItemVoxels voxels)
{
    return (voxels.info & kColumnsMask) != 0u;
}

// The barycentric edge functions of a triangle over the column of a voxel: component i belongs to vertex i.
i64vec3 cornersAt(RasterTriangle t, uvec3 voxel)
{
    ivec2 column = permuted(ivec3(voxel), t.axis).xy ^ t.mirror;
    ivec3 to_u = column.x * kVoxelLattice + kVoxelLattice / 2 - t.u;
    ivec3 to_v = column.y * kVoxelLattice + kVoxelLattice / 2 - t.v;
    i64vec3 corners = (product(t.edge_u, to_v) - product(t.edge_v, to_u)).yzx;
    return t.exchanged ? corners.xzy : corners;
}

// The first voxel of a brick.
ivec3 brickCorner(BrickEntry brick)
{
    uint level = uint(gridDepth() - 1) / 2u - 1u;
    return ivec3(brickCell(keyOf(brick), level)) << int(kBrickLog2);
}

#endif
