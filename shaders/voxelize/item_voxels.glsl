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

// ItemVoxels in registers: info, and the first and last layers of columns. Those of thin coverage have no last ones.
struct Voxels
{
    uint info;
    uvec2 layers;
    uvec2 last_layers;
};

const uint kVoxelsStride = kThin ? 1u : 2u; // ItemVoxels of an item

// An item without voxels, whose columns are those of t's box.
Voxels noVoxels(RasterTriangle t)
{
    uvec2 first = uvec2(t.low.xy) & 15u;
    uint info = (uint(t.high.x - t.low.x) & 15u) << kWidthShift | first.x << kFirstUShift | first.y << kFirstVShift |
                t.axis << kAxisShift | uint(t.mirror.x & 1) << kMirrorUShift | uint(t.mirror.y & 1) << kMirrorVShift;
    return Voxels(info, uvec2(0u), uvec2(0u));
}

// A layer among those of columns.
uvec2 layerOfColumn(uint column, int layer)
{
    uint bits = (uint(layer) & 15u) << (kLayerBits * (column & 7u));
    return column < 8u ? uvec2(bits, 0u) : uvec2(0u, bits);
}

uint layerIn(uvec2 layers, uint column)
{
    return ((column < 8u ? layers.x : layers.y) >> (kLayerBits * (column & 7u))) & 15u;
}

// The number of a voxel in its brick: that of its leaf, and six bits of the cell in it. voxel: in the brick.
uint numberOf(uvec3 voxel)
{
    return (cellInBlock(voxel >> 2) << 6) | cellInBlock(voxel);
}

// Takes the next voxel away from those of an item, which has one. Returns its place in the brick.
uvec3 takeVoxel(inout Voxels voxels)
{
    uint column = uint(findLSB(voxels.info & kColumnsMask));
    uint width = bitfieldExtract(voxels.info, int(kWidthShift), 4) + 1u;
    uint y = divideSmall(column, width);
    uint u = (bitfieldExtract(voxels.info, int(kFirstUShift), 4) + column - y * width) & 15u;
    uint v = (bitfieldExtract(voxels.info, int(kFirstVShift), 4) + y) & 15u;
    u ^= (voxels.info >> kMirrorUShift & 1u) != 0u ? 15u : 0u;
    v ^= (voxels.info >> kMirrorVShift) != 0u ? 15u : 0u;
    uint w = layerIn(voxels.layers, column);
    bool column_ends = kThin || w == layerIn(voxels.last_layers, column);
    voxels.info &= column_ends ? ~(1u << column) : ~0u;
    if (!kThin)
        voxels.layers += column_ends ? uvec2(0u) : layerOfColumn(column, 1);
    return uvec3(unpermuted(ivec3(u, v, w), bitfieldExtract(voxels.info, int(kAxisShift), 2)));
}

bool hasVoxels(Voxels voxels)
{
    return (voxels.info & kColumnsMask) != 0u;
}

#endif
