// SPDX-License-Identifier: MIT
// Finds the cells of the beam grid that touch an occupied cell of the octree, or have a neighbour of their own size
// that does. A workgroup of kBeamGroup threads takes a block of kBlockCells^3 cells, a thread 4x4x4 of them. What a
// cell and its neighbours touch is a box, so the occupied cells around the block spread along one axis after another.
//
// The includer defines before:
//   kEntriesPerWord    of the octree's lists; 0: there are none
#include "lib/morton.glsl"
#include "lib/node.glsl"

// A level of the beam grid, and that of the octree whose cells are about as large.
struct BeamLevel
{
    uint depth; // of the octree's nodes that have these cells
    int cells;  // of the octree along an edge: four a node
    int border; // cells of the beam grid outside of the cube, on each side
    int inner;  // those that cover the cube
};

const uint kBlockCells = 16u;
const uint kTouchedMax = 5u;    // cells of the octree along an axis that a cell and its neighbours touch
// 18 cells of the beam grid are as long as 18 * 256 / 248 < 19 of the octree: they touch at most 20, in 6 nodes.
const uint kWindowNodes = 6u;   // nodes of the octree along an axis that a block and its neighbours touch
const uint kWindowCells = 24u;  // their cells
const uint kNodesOfThread = 4u; // of the window: a thread looks for all at a time, so that many loads are under way

shared uint s_masks[2u * kNodesOfThread * kBeamGroup]; // of the window's nodes
shared uint s_rows[kWindowCells * kWindowCells];       // occupied cells along x: row y + z * kWindowCells
shared uint s_near_y[kBlockCells * kWindowCells];      // those near a cell of the block along y: y + z * kBlockCells
shared uint s_near_yz[kBlockCells * kBlockCells];      // along z, too: z + y * kBlockCells

// First and last cell of the octree, along one axis, that cell f and its neighbours touch; last < first: none.
ivec2 touched(BeamLevel level, int f)
{
    int first = max(f - level.border - 1, 0) * level.cells / level.inner;
    int last = (min(f - level.border + 2, level.inner) * level.cells + level.inner - 1) / level.inner - 1;
    return ivec2(first, last);
}

// Loads the masks of the window's nodes; 0 for those that do not exist. low, high: first and last along each axis.
void loadMasks(Node_ConstPtr octree, BeamLevel level, ivec3 low, ivec3 high)
{
    uvec3 at[kNodesOfThread];
    uint node[kNodesOfThread];
    bool present[kNodesOfThread];
    [[unroll]] for (uint i = 0u; i < kNodesOfThread; ++i)
    {
        uint number = gl_LocalInvocationIndex + i * kBeamGroup;
        at[i] = uvec3(low) + uvec3(number % kWindowNodes, number / kWindowNodes % kWindowNodes,
                                   number / (kWindowNodes * kWindowNodes));
        node[i] = 0u;
        present[i] = all(lessThanEqual(at[i], uvec3(high)));
    }
    for (uint depth = 0u; depth < level.depth; ++depth)
        [[unroll]] for (uint i = 0u; i < kNodesOfThread; ++i)
        {
            uint c = cellInBlock(at[i] >> (2u * (level.depth - 1u - depth)));
            Node parent = octree.data[present[i] ? node[i] : 0u];
            present[i] = present[i] && hasChild(parent, c);
            node[i] = childIndex(parent, c);
            if (kEntriesPerWord != 0u && present[i])
                node[i] = listedChild(octree, node[i], kEntriesPerWord);
        }
    [[unroll]] for (uint i = 0u; i < kNodesOfThread; ++i)
    {
        Node found = octree.data[present[i] ? node[i] : 0u];
        uint number = gl_LocalInvocationIndex + i * kBeamGroup;
        s_masks[2u * number] = present[i] ? found.mask_lo : 0u;
        s_masks[2u * number + 1u] = present[i] ? found.mask_hi : 0u;
    }
}

// The four cells of a node that have this y and z.
uint rowOfNode(uint number, uint y, uint z)
{
    uint cells = s_masks[2u * number + ((z >> 1) & 1u)] >> (cellInBlock(uvec3(0u, y, z)) & 31u);
    return (cells & 3u) | ((cells >> 6) & 12u); // x 0, 1; x 2, 3
}

void joinRows()
{
    for (uint row = gl_LocalInvocationIndex; row < kWindowCells * kWindowCells; row += kBeamGroup)
    {
        uint y = row % kWindowCells;
        uint z = row / kWindowCells;
        uint first = (y / 4u + z / 4u * kWindowNodes) * kWindowNodes;
        uint cells = 0u;
        [[unroll]] for (uint x = 0u; x < kWindowNodes; ++x)
            cells |= rowOfNode(first + x, y, z) << (4u * x);
        s_rows[row] = cells;
    }
}

// Spreads rows along y, then along z. The ranges are of a thread's cell along these axes.
void spread(ivec2 range_y, ivec2 range_z)
{
    uint cell = gl_LocalInvocationIndex % kBlockCells;
    uint first = gl_LocalInvocationIndex / kBlockCells;
    const uint step = kBeamGroup / kBlockCells;
    for (uint z = first; z < kWindowCells; z += step)
    {
        uint near = 0u;
        [[unroll]] for (int i = 0; i < int(kTouchedMax); ++i)
            near |= s_rows[uint(range_y.x + min(i, max(range_y.y - range_y.x, 0))) + z * kWindowCells];
        s_near_y[cell + z * kBlockCells] = range_y.y < range_y.x ? 0u : near;
    }
    barrier();
    for (uint y = first; y < kBlockCells; y += step)
    {
        uint near = 0u;
        [[unroll]] for (int i = 0; i < int(kTouchedMax); ++i)
            near |= s_near_y[y + uint(range_z.x + min(i, max(range_z.y - range_z.x, 0))) * kBlockCells];
        s_near_yz[cell + y * kBlockCells] = range_z.y < range_z.x ? 0u : near;
    }
}

// The cells of a 4x4x4 part of the block that are near something. ranges: along x, as bits, of its four cells.
uvec2 nearCells(uvec3 part, uvec4 ranges)
{
    uvec2 cells = uvec2(0u);
    [[unroll]] for (uint z = 0u; z < 4u; ++z)
    {
        uint half_cells = 0u;
        [[unroll]] for (uint y = 0u; y < 4u; ++y)
        {
            uint row = s_near_yz[4u * part.z + z + (4u * part.y + y) * kBlockCells];
            uvec4 near = uvec4(notEqual(row & ranges, uvec4(0u)));
            uint at = cellInBlock(uvec3(0u, y, z)) & 31u;
            half_cells |= (near.x << at) | (near.y << (at + 1u)) | (near.z << (at + 8u)) | (near.w << (at + 9u));
        }
        cells |= z < 2u ? uvec2(half_cells, 0u) : uvec2(0u, half_cells);
    }
    return cells;
}

// Bits of a row of the window.
uint rangeBits(ivec2 range)
{
    return range.y < range.x ? 0u : ((2u << (range.y - range.x)) - 1u) << range.x;
}

// The 64 cells of a thread, in Morton order as the threads, of the block at these coordinates. Call in uniform control
// flow; may be called again.
uvec2 dilatedCells(Node_ConstPtr octree, BeamLevel level, uvec3 block)
{
    ivec3 first = ivec3(kBlockCells * block);
    ivec3 end = first + int(kBlockCells) - 1;
    ivec3 low = ivec3(touched(level, first.x).x, touched(level, first.y).x, touched(level, first.z).x) >> 2;
    ivec3 high = ivec3(touched(level, end.x).y, touched(level, end.y).y, touched(level, end.z).y) >> 2;
    loadMasks(octree, level, low, high);
    barrier();
    joinRows();
    barrier();
    int cell = int(gl_LocalInvocationIndex % kBlockCells);
    spread(touched(level, first.y + cell) - 4 * low.y, touched(level, first.z + cell) - 4 * low.z);
    barrier();
    uvec3 part = mortonDecode(gl_LocalInvocationIndex);
    int x = first.x + 4 * int(part.x);
    return nearCells(part, uvec4(rangeBits(touched(level, x) - 4 * low.x), rangeBits(touched(level, x + 1) - 4 * low.x),
                                 rangeBits(touched(level, x + 2) - 4 * low.x),
                                 rangeBits(touched(level, x + 3) - 4 * low.x)));
}
