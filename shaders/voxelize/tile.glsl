// SPDX-License-Identifier: MIT
// Thin coverage by tiles: the 4x4 columns above one leaf. A plane crosses at most kTileLeaves leaves in a tile, because
// its height changes by at most one layer from column to column. So the brick table is searched at most that often for
// up to 16 voxels, whose bits are set together. The rest is arithmetic in a thread's own registers.
#ifndef ZVO_SHADERS_VOXELIZE_TILE_GLSL
#define ZVO_SHADERS_VOXELIZE_TILE_GLSL

#include "lib/bricks.glsl"
#include "voxelize/fragment.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/tile_walk.glsl"
#include "voxelize/voxelize.h"

const uint kTileLeaves = 3u; // 7 layers

struct Tile
{
    ivec2 column;             // first column
    int w_low;                // its layer: no layer of the plane above the tile is lower
    uvec2 masks[kTileLeaves]; // covered voxels of the leaves, from the one that holds w_low up
};

// Columns of a tile along each axis.
int tileExtent(RasterTriangle t)
{
    ivec3 edges = max(abs(t.edge_u), max(abs(t.edge_v), abs(t.edge_w)));
    return max(edges.x, max(edges.y, edges.z)) <= kTileExtent ? 4 : 1;
}

// Bits of the number of a voxel inside its leaf that belong to coordinate c of axis.
uint cellBits(uint c, uint axis)
{
    return ((c & 1u) | ((c & 2u) << 2)) << axis;
}

// Adds a voxel, if present, to the masks of the leaves above a tile. layer: from the lowest leaf's first one on.
void addToMasks(bool present, uint cell, uint layer, inout uvec2 masks[kTileLeaves])
{
    uint bit = present ? 1u << (cell & 31u) : 0u;
    uint word = ((layer >> 2) << 1) | (cell >> 5);
    masks[0].x |= word == 0u ? bit : 0u;
    masks[0].y |= word == 1u ? bit : 0u;
    masks[1].x |= word == 2u ? bit : 0u;
    masks[1].y |= word == 3u ? bit : 0u;
    masks[2].x |= word == 4u ? bit : 0u;
    masks[2].y |= word == 5u ? bit : 0u;
}

// extent: of the tile.
Tile coverTile(RasterTriangle t, ivec2 column, int extent)
{
    TileCell row = startTile(t, column);

    Tile tile;
    tile.column = column;
    tile.w_low = row.w;
    tile.masks = uvec2[](uvec2(0u), uvec2(0u), uvec2(0u));
    ivec2 last = min(t.high.xy, column + extent - 1);
    uint axis_u = t.axis == 2u ? 0u : t.axis + 1u;
    uint axis_v = axis_u == 2u ? 0u : axis_u + 1u;
    int leaf_low = tile.w_low & ~3;
    for (int j = 0; j < 4; ++j)
    {
        TileCell cell = row;
        int v = column.y + j;
        int outside_v = (v - t.low.y) | (last.y - v);
        for (int i = 0; i < 4; ++i)
        {
            int u = column.x + i;
            int outside = outside_v | (u - t.low.x) | (last.x - u);
            bool covered = outside >= 0 && isCovered(t, cell);
            uint number = cellBits(uint(u ^ t.mirror.x), axis_u) | cellBits(uint(v ^ t.mirror.y), axis_v) |
                          cellBits(uint(cell.w), t.axis);
            addToMasks(covered, number, uint(cell.w - leaf_low), tile.masks);
            nextColumn(t, cell);
        }
        nextRow(t, row);
    }
    return tile;
}

// Word number `word` of the masks of a tile's leaves.
uint wordOfMasks(Tile tile, uint word)
{
    uvec2 mask = word < 2u ? tile.masks[0] : (word < 4u ? tile.masks[1] : tile.masks[2]);
    return (word & 1u) == 0u ? mask.x : mask.y;
}

// One loop over the words that are not empty, mostly two or three: unrolled, software devices would run the body for
// empty ones, too.
void setTile(RasterTriangle t, Tile tile)
{
    uint words = 0u;
    [[unroll]] for (uint word = 0u; word < 2u * kTileLeaves; ++word)
        words |= wordOfMasks(tile, word) != 0u ? 1u << word : 0u;
    BrickCursor cursor = noBrick();
    for (; words != 0u; words &= words - 1u)
    {
        uint word = uint(findLSB(words));
        int leaf = (tile.w_low >> 2) + int(word >> 1);
        moveToBrick(leafKey(uvec3(voxelOf(t, tile.column, leaf * 4))), cursor);
        if (cursor.entry != kNoEntry)
            setVoxels(cursor, word & 1u, wordOfMasks(tile, word));
    }
}

#endif
