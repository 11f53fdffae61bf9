// SPDX-License-Identifier: MIT
// The piece of a triangle that an item stands for, and the cells that it can reach.
// Needs what voxelize/item.glsl needs, and params.voxels, resolution and band.
#ifndef ZVO_SHADERS_DISTANCE_PIECE_GLSL
#define ZVO_SHADERS_DISTANCE_PIECE_GLSL

#include "distance/distance.h"
#include "lib/bound.glsl"
#include "lib/brick_loads.glsl"
#include "voxelize/item.glsl"

#ifdef BOUND
STORAGE(14, ItemVoxels, voxels);
#define LOADED_VOXELS(I) storage_voxels.data[I]
#else
#define LOADED_VOXELS(I) params.voxels.data[I]
#endif

// Coordinates are on the grid's lattice.
struct Piece
{
    ivec3 v0; // of the whole triangle
    ivec3 v1;
    ivec3 v2;
    ivec3 low; // the closed box around the piece; low > high: there is none
    ivec3 high;
};

// From the lattice of the voxelization to that of the grid.
const ivec3 kToGrid = -ivec3(kBandMarginLattice, kBandMarginLattice + kVoxelLattice / 2, kBandMarginLattice);

ivec3 cornerOf(TriangleSetup setup, int corner, ivec2 mirror)
{
    ivec3 place = (corner == 0 ? ivec3(setup.u.x, setup.v.x, setup.w.x)
                                    : (corner == 1 ? ivec3(setup.u.y, setup.v.y, setup.w.y)
                                                   : ivec3(setup.u.z, setup.v.z, setup.w.z)));
    place.xy = (place.xy ^ mirror) - mirror;
    return unpermuted(place, setup.flags & kSetupAxis) + kToGrid;
}

Piece pieceOf(uint i)
{
    BrickItem item = loadItem(i);
    BrickEntry entry = loadBrick(item.entry);
    ItemVoxels first = LOADED_VOXELS(kVoxelsStride * i);
    ItemVoxels last = LOADED_VOXELS(kVoxelsStride * i + 1u);
    uvec2 layers = uvec2(first.layers_lo, first.layers_hi);
    uvec2 last_layers = uvec2(last.layers_lo, last.layers_hi);
    uint width = bitfieldExtract(first.info, int(kWidthShift), 4) + 1u;
    uint mirror_u = (first.info >> kMirrorUShift & 1u) != 0u ? 15u : 0u;
    uint mirror_v = (first.info >> kMirrorVShift) != 0u ? 15u : 0u;
    uvec3 low = uvec3(16u);
    uvec3 high = uvec3(0u);
    for (uint columns = first.info & kColumnsMask; columns != 0u; columns &= columns - 1u)
    {
        uint column = uint(findLSB(columns));
        uint row = divideSmall(column, width);
        uint u = ((bitfieldExtract(first.info, int(kFirstUShift), 4) + column - row * width) & 15u) ^ mirror_u;
        uint v = ((bitfieldExtract(first.info, int(kFirstVShift), 4) + row) & 15u) ^ mirror_v;
        low = min(low, uvec3(u, v, layerIn(layers, column)));
        high = max(high, uvec3(u, v, layerIn(last_layers, column)));
    }
    uint axis = bitfieldExtract(first.info, int(kAxisShift), 2);
    ivec3 corner = brickCorner(entry);
    TriangleSetup setup = loadSetup(item.triangle);
    ivec2 mirror = mirrorOf(setup);
    Piece piece;
    piece.v0 = cornerOf(setup, 0, mirror);
    piece.v1 = cornerOf(setup, 1, mirror);
    piece.v2 = cornerOf(setup, 2, mirror);
    piece.low = max((corner + unpermuted(ivec3(low), axis)) * kVoxelLattice + kToGrid,
                    min(piece.v0, min(piece.v1, piece.v2)));
    piece.high = min((corner + unpermuted(ivec3(high), axis) + 1) * kVoxelLattice + kToGrid,
                     max(piece.v0, max(piece.v1, piece.v2)));
    return piece;
}

// Cells from low to high, both included; low > high: none.
struct Cells
{
    ivec3 low;
    ivec3 high;
};

bool isEmpty(Cells cells)
{
    return any(greaterThan(cells.low, cells.high));
}

// The cells of the grid whose centres the piece's box may have in the band.
Cells cellsInReach(Piece piece)
{
    int reach = int(params.band) * kVoxelLattice - kVoxelLattice / 2;
    Cells cells = Cells(max((piece.low - reach - 1) >> kVoxelLatticeLog2, ivec3(0)),
                        min((piece.high + reach) >> kVoxelLatticeLog2, ivec3(int(params.resolution) - 1)));
    if (any(greaterThan(piece.low, piece.high)))
        cells.high = cells.low - 1;
    return cells;
}

#endif
