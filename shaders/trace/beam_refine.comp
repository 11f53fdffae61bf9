#version 460
// SPDX-License-Identifier: MIT
// Last pass of the beam grid, for octrees with at least four levels of nodes: writes its finest level. The cells of
// that level are a quarter as large. Below each set cell, those cells are set that touch an occupied cell of the
// octree's fourth level, or have a neighbour of their own size that does.
#extension GL_GOOGLE_include_directive : require
#include "trace/beam.h"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

layout(constant_id = 0) const uint kEntriesPerWord = 0u; // of lists; 0: there are none

layout(local_size_x = kBeamGroup) in;
layout(push_constant, scalar) uniform Push
{
    BeamRefineParams params;
};

const int kCells = 256;                         // of the octree's fourth level, along an edge
const int kBorder = 4;                          // fine cells outside of the cube, on each side
const int kInner = 4 * int(kBeamCells) - 2 * kBorder; // fine cells that cover the cube

// Bits of the cells of a 2x2x2 octant, a byte of a mask, whose x, y or z is the lower one.
const uint kLowerX = 85u;
const uint kLowerY = 51u;
const uint kLowerZ = 15u;
// Times the bits of an octant: the same bits in several of the four octants of a half.
const uint kInAllOctants = 16843009u;
const uint kInLowerX = 65537u; // in both whose x is the lower one
const uint kInLowerY = 257u;
const uint kOctantsToHigherX = 8u; // bits from octants to those with the higher x
const uint kOctantsToHigherY = 16u;

// First and last octree cell, along one axis, that fine cell f and its neighbours touch.
ivec2 touched(int f)
{
    int first = max(f - kBorder - 1, 0) * kCells / kInner;
    int last = (min(f - kBorder + 2, kInner) * kCells + kInner - 1) / kInner - 1;
    return ivec2(first, last);
}

// The cells of a 4x4x4 block with this coordinate along an axis.
uvec2 blockSlice(uint axis, uint coordinate)
{
    uint low = (axis == 0u ? kLowerX : axis == 1u ? kLowerY : kLowerZ) << ((coordinate & 1u) << axis); // of an octant
    uint high = coordinate >> 1;
    if (axis == 2u)
        return low * kInAllOctants * uvec2(1u - high, high); // in all octants of a half
    return uvec2(axis == 0u ? (low * kInLowerX) << (high * kOctantsToHigherX)
                            : (low * kInLowerY) << (high * kOctantsToHigherY));
}

// The fine cells of the block from fine cell `first` on, along an axis, that octree cell c sets.
uvec2 cellsSet(uint axis, int first, int c)
{
    uvec2 cells = uvec2(0u);
    for (int i = 0; i < 4; ++i)
    {
        ivec2 range = touched(first + i);
        cells |= c >= range.x && c <= range.y ? blockSlice(axis, uint(i)) : uvec2(0u);
    }
    return cells;
}

// Mask of the node of the octree's fourth level at these coordinates; 0 if there is none.
uvec2 fourthLevelMask(ivec3 at)
{
    uint node = 0u;
    bool present = true;
    for (uint level = 0u; level < 3u; ++level)
    {
        uint c = cellInBlock(uvec3(at) >> (2u * (2u - level)));
        Node n = params.octree.data[present ? node : 0u];
        present = present && hasChild(n, c);
        node = childIndex(n, c);
        if (kEntriesPerWord != 0u && present)
            node = listedChild(params.octree, node, kEntriesPerWord);
    }
    Node n = params.octree.data[present ? node : 0u];
    return present ? uvec2(n.mask_lo, n.mask_hi) : uvec2(0u);
}

// Fine cells that the cells of one octree node set.
uvec2 setByNode(uvec2 mask, ivec3 at, ivec3 first)
{
    uvec2 by_x[4];
    uvec2 by_y[4];
    [[unroll]] for (int i = 0; i < 4; ++i)
    {
        by_x[i] = cellsSet(0u, first.x, 4 * at.x + i);
        by_y[i] = cellsSet(1u, first.y, 4 * at.y + i);
    }
    uvec2 cells = uvec2(0u);
    [[unroll]] for (int z = 0; z < 4; ++z)
    {
        uvec2 by_z = cellsSet(2u, first.z, 4 * at.z + z);
        [[unroll]] for (int y = 0; y < 4; ++y)
        {
            uvec2 row = uvec2(0u);
            [[unroll]] for (int x = 0; x < 4; ++x)
            {
                uint c = cellInBlock(uvec3(x, y, z));
                row |= (((c < 32u ? mask.x : mask.y) >> (c & 31u)) & 1u) != 0u ? by_x[x] : uvec2(0u);
            }
            cells |= row & by_y[y] & by_z;
        }
    }
    return cells;
}

void main()
{
    uint morton = threadIndex(); // of a coarse cell
    uvec2 siblings = unpackUint2x32(params.masks.data[morton >> 6]);
    uint half_mask = (morton & 32u) == 0u ? siblings.x : siblings.y;
    uint bit = 1u << (morton & 31u);
    if ((half_mask & bit) == 0u)
        return;
    ivec3 first = 4 * ivec3(mortonDecode(morton));
    ivec3 low = ivec3(touched(first.x).x, touched(first.y).x, touched(first.z).x) >> 2;
    ivec3 high = ivec3(touched(first.x + 3).y, touched(first.y + 3).y, touched(first.z + 3).y) >> 2;
    uvec2 cells = uvec2(0u);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x)
                cells |= setByNode(fourthLevelMask(ivec3(x, y, z)), ivec3(x, y, z), first);
    uint slot = kBeamFirst3 + (morton & ~31u) + bitCount(half_mask & (bit - 1u));
    params.nodes.data[slot] = Node(cells.x, 0u, cells.y, 0u);
}
