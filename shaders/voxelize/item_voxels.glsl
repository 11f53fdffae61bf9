// SPDX-License-Identifier: MIT
// The voxels of an item (voxelize/bricks.h).
// Needs what voxelize/raster.glsl needs.
#ifndef ZVO_SHADERS_VOXELIZE_ITEM_VOXELS_GLSL
#define ZVO_SHADERS_VOXELIZE_ITEM_VOXELS_GLSL

#include "lib/arithmetic.glsl"
#include "lib/morton.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/bricks.h"

const uint kLayerBits = 4u; // of a layer's number in a brick
const uint kColumnsMask = (1u << kItemColumns) - 1u;
const uint kWidthShift = 16u;
const uint kFirstUShift = 20u;
const uint kFirstVShift = 24u;
const uint kAxisShift = 28u;
const uint kMirrorUShift = 30u;
const uint kMirrorVShift = 31u;

// Without voxels. t: of which the columns are those of its box.
ItemVoxels noVoxels(RasterTriangle t)
{
    uvec2 first = uvec2(t.low.xy) & 15u;
    uint info = (uint(t.high.x - t.low.x) & 15u) << kWidthShift | first.x << kFirstUShift | first.y << kFirstVShift |
                t.axis << kAxisShift | uint(t.mirror.x & 1) << kMirrorUShift | uint(t.mirror.y & 1) << kMirrorVShift;
    return ItemVoxels(info, 0u, 0u);
}

void addVoxel(bool present, uint column, int layer, inout ItemVoxels voxels)
{
    uint bits = present ? (uint(layer) & 15u) << (kLayerBits * (column & 7u)) : 0u;
    voxels.info |= present ? 1u << column : 0u;
    voxels.layers_lo |= column < 8u ? bits : 0u;
    voxels.layers_hi |= column < 8u ? 0u : bits;
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
    uint u = bitfieldExtract(voxels.info, int(kFirstUShift), 4) + column - y * width & 15u;
    uint v = bitfieldExtract(voxels.info, int(kFirstVShift), 4) + y & 15u;
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

#endif
