// SPDX-License-Identifier: MIT
// Thin coverage by tiles: the 4x4 columns above one leaf. A plane crosses at most kTileLeaves leaves in a tile, because
// its height changes by at most one layer from column to column. So the brick table is searched at most that often for
// up to 16 voxels, whose bits are set together. The rest is arithmetic in a thread's own registers.

const uint kTileLeaves = 3u; // 7 layers

struct Tile
{
    ivec2 column;             // first column, a multiple of 4
    int w_low;                // no layer of the plane above the tile is lower
    uvec2 masks[kTileLeaves]; // covered voxels of the leaves, from the one that holds w_low up
};

// The members of a RasterCell that thin coverage needs.
struct TileCell
{
    EDGE_IVEC3 uv;
    EDGE_IVEC3 vw;
    EDGE_IVEC3 wu;
    int w;
    EDGE_INT rest; // of the layer's division by n_w
};

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

Tile coverTile(RasterTriangle t, ivec2 column)
{
    RasterCell first = startColumn(t, column);
    TileCell row = TileCell(first.uv, first.vw, first.wu, first.w, first.rest);
    EDGE_IVEC3 vw_up = t.dv * t.s_u; // to the next layer
    EDGE_IVEC3 wu_up = t.du * -t.s_v;
    EDGE_IVEC3 uv_column = t.dv * -t.s_w; // to the next column along u
    EDGE_IVEC3 wu_column = t.dw * t.s_v;
    EDGE_IVEC3 uv_row = t.du * t.s_w; // and along v
    EDGE_IVEC3 vw_row = t.dw * -t.s_u;

    Tile tile;
    tile.column = column;
    tile.w_low = first.w - (t.n_u > 0 ? 3 : 0) - (t.n_v > 0 ? 3 : 0);
    tile.masks = uvec2[](uvec2(0u), uvec2(0u), uvec2(0u));
    uint axis_u = t.axis == 2u ? 0u : t.axis + 1u;
    uint axis_v = axis_u == 2u ? 0u : axis_u + 1u;
    int leaf_low = tile.w_low & ~3;
    for (int j = 0; j < 4; ++j)
    {
        TileCell cell = row;
        int v = column.y + j;
        bool in_rows = v >= t.low.y && v <= t.high.y;
        for (int i = 0; i < 4; ++i)
        {
            int u = column.x + i;
            EDGE_IVEC3 least = min(cell.uv, min(cell.vw, cell.wu));
            bool covered = in_rows && u >= t.low.x && u <= t.high.x && cell.w >= t.low.z && cell.w <= t.high.z &&
                           min(least.x, min(least.y, least.z)) >= 0;
            uint number = cellBits(uint(i), axis_u) | cellBits(uint(j), axis_v) | cellBits(uint(cell.w), t.axis);
            addToMasks(covered, number, uint(cell.w - leaf_low), tile.masks);
            int move = stepLayer(t, -t.n_u, cell.rest);
            cell.w += move;
            cell.uv += uv_column;
            cell.vw += vw_up * EDGE_INT(move);
            cell.wu += wu_column + wu_up * EDGE_INT(move);
        }
        int move = stepLayer(t, -t.n_v, row.rest);
        row.w += move;
        row.uv += uv_row;
        row.vw += vw_row + vw_up * EDGE_INT(move);
        row.wu += wu_up * EDGE_INT(move);
    }
    return tile;
}

void setTile(RasterTriangle t, Tile tile)
{
    for (uint leaf = 0u; leaf < kTileLeaves; ++leaf)
    {
        uvec2 mask = leaf == 0u ? tile.masks[0] : (leaf == 1u ? tile.masks[1] : tile.masks[2]);
        if (mask != uvec2(0u))
        {
            BrickCursor cursor = noBrick();
            moveToBrick(leafKey(uvec3(voxelOf(t, tile.column, ((tile.w_low >> 2) + int(leaf)) * 4))), cursor);
            if (cursor.entry != kNoEntry)
                setVoxels(cursor.entry, mask);
        }
    }
}
