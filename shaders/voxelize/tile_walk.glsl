// SPDX-License-Identifier: MIT
// A walk over the columns of a tile, or of the box of a triangle with at most 16 columns, in 32-bit integers, for thin
// coverage.
//
// Edge functions move by multiples of 256, the edge vectors times 256, so that floor(edge function / 256) moves by the
// edge vectors and has the same sign. In a tile an edge function moves by at most 3 columns, 3 rows and 6 layers, and
// vw and wu by 9 edge components: for edges of up to kTileExtent = 2^26 that is less than 2^30. So a quotient that
// begins outside of [-2^30, 2^30) keeps its sign in the tile, also when it begins at the end of that interval instead,
// and no quotient leaves 32 bits. Triangles of larger edges have items of one column, in which nothing moves. A
// triangle of at most kSmallExtent has numbers below 2^30 in all of its columns.
#ifndef ZVO_SHADERS_VOXELIZE_TILE_WALK_GLSL
#define ZVO_SHADERS_VOXELIZE_TILE_WALK_GLSL

#include "voxelize/raster.glsl"
#include "voxelize/voxelize.h"

// The members of a RasterCell that thin coverage needs, edge functions divided by 256.
struct TileCell
{
    ivec3 uv;
    ivec3 vw;
    ivec3 wu;
    int w;
    EDGE_INT rest; // of the layer's division by n_w
};

// floor(edge / 256), brought into [-2^30, 2^30).
ivec3 tileEdge(i64vec3 edge)
{
    ivec3 beyond = ivec3(edge >> (kVoxelLatticeLog2 + 30)); // 0 or -1 inside
    ivec3 quotient = ivec3(edge >> kVoxelLatticeLog2);
    quotient = mix(quotient, ivec3((1 << 30) - 1), greaterThan(beyond, ivec3(0)));
    return mix(quotient, ivec3(-(1 << 30)), lessThan(beyond, ivec3(-1)));
}

TileCell startTile(RasterTriangle t, ivec2 column)
{
    RasterCell first = startColumn(t, column);
    return TileCell(tileEdge(first.uv), tileEdge(first.vw), tileEdge(first.wu), first.w, first.rest);
}

void nextColumn(RasterTriangle t, inout TileCell cell)
{
    bool up = stepLayer(t, t.rise_u, cell.rest);
    cell.w += up ? 1 : 0;
    cell.uv -= t.edge_v;
    cell.vw -= up ? t.edge_v : ivec3(0);
    cell.wu += (up ? t.edge_u : ivec3(0)) - t.edge_w;
}

void nextRow(RasterTriangle t, inout TileCell cell)
{
    bool up = stepLayer(t, t.rise_v, cell.rest);
    cell.w += up ? 1 : 0;
    cell.uv += t.edge_u;
    cell.vw += t.edge_w - (up ? t.edge_v : ivec3(0));
    cell.wu += up ? t.edge_u : ivec3(0);
}

bool isCovered(RasterTriangle t, TileCell cell)
{
    ivec3 signs = cell.uv | cell.vw | cell.wu;
    return (signs.x | signs.y | signs.z | (cell.w - t.low.z) | (t.high.z - cell.w)) >= 0;
}

#endif
