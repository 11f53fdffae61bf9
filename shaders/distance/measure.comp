#version 460
// SPDX-License-Identifier: MIT
// The distances of centres to the pieces of triangles, kLanes threads an item: a piece and the cells around it are even
// work. Floating point tells how far a centre is at most; then, with kExact, which triangles may be the nearest, a few
// for each centre, and these are measured in integers. A piece takes no part where its box is farther away than the
// triangle: another one has the nearest point.
#extension GL_GOOGLE_include_directive : require
#include "distance/distance.h"

GPU_ENTRY(MeasureParams, DISTANCE_MEASURE_CONSTANTS);
layout(local_size_x = kMeasureGroup) in;

const uint kCoverage = kCoverageConservative;
const bool kEmits = false;

#define BRICKS_BINDING 0
#include "distance/piece.glsl"
#include "distance/band_keys.glsl"
#include "distance/estimate.glsl"
#include "lib/dispatch.glsl"

#ifdef BOUND
STORAGE(2, uint, bounds);
STORAGE(3, uint, squared);
#define BOUND_WORD(I) storage_bounds.data[I]
#define SQUARED(I) storage_squared.data[I]
#else
#define BOUND_WORD(I) params.bounds.data[I]
#define SQUARED(I) params.squared.data[I]
#endif

const float kFarAway = 1.0e9;

// The cells of a brick that a piece may reach, and where their words are.
struct BrickCells
{
    ivec3 low;
    uvec3 size;
    uvec2 leaves;
    uint first_leaf;
};

BrickCells cellsInBrick(ivec3 brick, Cells cells)
{
    BrickCells found;
    ivec3 corner = brick << int(kBrickLog2);
    found.low = max(cells.low, corner);
    found.size = uvec3(min(cells.high, corner + ((1 << kBrickLog2) - 1)) - found.low + 1);
    BrickEntry entry;
    brickFind(bandKey(uvec3(brick)), entry);
    BandBrick listed = params.listed.data[entry.mask_lo];
    found.leaves = uvec2(listed.mask_lo, listed.mask_hi);
    found.first_leaf = listed.first_leaf;
    return found;
}

ivec3 cellNumber(BrickCells cells, uint i)
{
    uint row = divideSmall(i, cells.size.x);
    uint layer = divideSmall(row, cells.size.y);
    return cells.low + ivec3(i - row * cells.size.x, row - layer * cells.size.y, layer);
}

uint wordOf(BrickCells cells, uvec3 cell)
{
    uint leaf = cellInBlock(cell >> 2);
    uint below = (1u << (leaf & 31u)) - 1u;
    uint rank = leaf < 32u ? bitCount(cells.leaves.x & below)
                           : bitCount(cells.leaves.x) + bitCount(cells.leaves.y & below);
    return (cells.first_leaf + rank) * kCentersInBand + cellInBlock(cell);
}

ivec3 centerOf(ivec3 cell)
{
    return cell * kVoxelLattice + kVoxelLattice / 2;
}

struct PieceView
{
    TriangleView triangle;
    ivec3 origin;
    vec3 half_size; // of the piece's box around the origin
};

// The bounds of a centre's distance, if the piece may have the nearest point; else one that is too far away.
vec2 boundsAt(PieceView view, ivec3 cell)
{
    vec3 point = vec3(centerOf(cell) - view.origin);
    vec2 bounds = distanceBounds(view.triangle, point);
    vec3 off = max(abs(point) - view.half_size, vec3(0.0));
    return dot(off, off) <= bounds.y * bounds.y ? bounds : vec2(kFarAway);
}

void measureBrick(Piece piece, PieceView view, BrickCells cells, uint lane)
{
    uint count = cells.size.x * cells.size.y * cells.size.z;
    uint next = lane;
    while (next < count)
    {
        // The next cell to which the triangle may be the nearest.
        uint chosen = count;
        while (next < count && chosen == count)
        {
            ivec3 cell = cellNumber(cells, next);
            uint word = wordOf(cells, uvec3(cell));
            vec2 bounds = boundsAt(view, cell);
            float least = uintBitsToFloat(BOUND_WORD(word));
            if (kExact)
                chosen = bounds.x <= least ? next : count;
            else if (bounds.y < least)
                atomicMin(BOUND_WORD(word), floatBitsToUint(bounds.y));
            next += kLanes;
        }
        if (kExact && chosen < count)
        {
            ivec3 cell = cellNumber(cells, chosen);
            uint squared = squaredDistance(centerOf(cell), piece.v0, piece.v1, piece.v2);
            uint band = params.band << (kVoxelLatticeLog2 + int(kDistanceBits / 2u));
            if (squared <= band * band)
                atomicMin(SQUARED(wordOf(cells, uvec3(cell))), squared);
        }
    }
}

void main()
{
    uint i = threadIndex() / kLanes;
    if (i >= params.item_count)
        return;
    Piece piece = pieceOf(i);
    Cells cells = cellsInReach(piece);
    if (isEmpty(cells))
        return;
    PieceView view;
    view.origin = (piece.low + piece.high) >> 1;
    view.half_size = vec3(piece.high - view.origin + 1);
    view.triangle = triangleView(piece.v0, piece.v1, piece.v2, view.origin);
    ivec3 first = cells.low >> int(kBrickLog2);
    ivec3 last = cells.high >> int(kBrickLog2);
    ivec3 size = last - first + 1;
    ivec3 brick = first;
    for (int left = size.x * size.y * size.z; left > 0; --left)
    {
        measureBrick(piece, view, cellsInBrick(brick, cells), threadIndex() % kLanes);
        bool row_ends = brick.x == last.x;
        bool layer_ends = row_ends && brick.y == last.y;
        brick = ivec3(row_ends ? first.x : brick.x + 1, layer_ends ? first.y : brick.y + (row_ends ? 1 : 0),
                      brick.z + (layer_ends ? 1 : 0));
    }
}
