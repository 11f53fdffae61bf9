// SPDX-License-Identifier: MIT
// Thin coverage by tiles: the 4x4 columns above one leaf. A plane crosses at most kTileLeaves leaves in a tile, because
// its height changes by at most one layer from column to column. So the brick table is searched at most that often for
// up to 16 voxels, whose bits are set together. The rest is arithmetic in a thread's own registers.
//
// Edge functions move by multiples of 256, the edge vectors times 256, so that floor(edge function / 256) moves by the
// edge vectors and has the same sign. In a tile an edge function moves by at most 3 columns, 3 rows and 6 layers, and
// vw and wu by 9 edge components: for edges of up to kTileExtent = 2^26 that is less than 2^30. So a quotient that
// begins outside of [-2^30, 2^30) keeps its sign in the tile, also when it begins at the end of that interval instead,
// and no quotient leaves 32 bits. Triangles of larger edges have tiles of one column, in which nothing moves.
#ifndef ZVO_SHADERS_VOXELIZE_TILE_GLSL
#define ZVO_SHADERS_VOXELIZE_TILE_GLSL

#include "lib/bricks.glsl"
#include "voxelize/fragment.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/voxelize.h"

const uint kTileLeaves = 3u; // 7 layers

struct Tile
{
    ivec2 column;             // first column
    int w_low;                // its layer: no layer of the plane above the tile is lower
    uvec2 masks[kTileLeaves]; // covered voxels of the leaves, from the one that holds w_low up
};

// The members of a RasterCell that thin coverage needs, edge functions divided by 256.
struct TileCell
{
    ivec3 uv;
    ivec3 vw;
    ivec3 wu;
    int w;
    EDGE_INT rest; // of the layer's division by n_w
};

// Columns of a tile along each axis.
int tileExtent(RasterTriangle t)
{
    ivec3 edges = max(abs(t.edge_u), max(abs(t.edge_v), abs(t.edge_w)));
    return max(edges.x, max(edges.y, edges.z)) <= kTileExtent ? 4 : 1;
}

// floor(edge / 256), brought into [-2^30, 2^30).
ivec3 tileEdge(i64vec3 edge)
{
    ivec3 beyond = ivec3(edge >> (kVoxelLatticeLog2 + 30)); // 0 or -1 inside
    ivec3 quotient = ivec3(edge >> kVoxelLatticeLog2);
    quotient = mix(quotient, ivec3((1 << 30) - 1), greaterThan(beyond, ivec3(0)));
    return mix(quotient, ivec3(-(1 << 30)), lessThan(beyond, ivec3(-1)));
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
    RasterCell first = startColumn(t, column);
    TileCell row = TileCell(tileEdge(first.uv), tileEdge(first.vw), tileEdge(first.wu), first.w, first.rest);

    Tile tile;
    tile.column = column;
    tile.w_low = first.w;
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
            int outside = outside_v | (u - t.low.x) | (last.x - u) | (cell.w - t.low.z) | (t.high.z - cell.w);
            ivec3 signs = cell.uv | cell.vw | cell.wu;
            bool covered = (signs.x | signs.y | signs.z | outside) >= 0;
            uint number = cellBits(uint(u ^ t.mirror.x), axis_u) | cellBits(uint(v ^ t.mirror.y), axis_v) |
                          cellBits(uint(cell.w), t.axis);
            addToMasks(covered, number, uint(cell.w - leaf_low), tile.masks);
            bool up = stepLayer(t, t.rise_u, cell.rest);
            cell.w += up ? 1 : 0;
            cell.uv -= t.edge_v;
            cell.vw -= up ? t.edge_v : ivec3(0);
            cell.wu += (up ? t.edge_u : ivec3(0)) - t.edge_w;
        }
        bool up = stepLayer(t, t.rise_v, row.rest);
        row.w += up ? 1 : 0;
        row.uv += t.edge_u;
        row.vw += t.edge_w - (up ? t.edge_v : ivec3(0));
        row.wu += up ? t.edge_u : ivec3(0);
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
