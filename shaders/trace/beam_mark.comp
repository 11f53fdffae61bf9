#version 460
// SPDX-License-Identifier: MIT
// First pass of the beam grid: finds the occupied cells of a coarse grid, from the upper levels of the octree.
#extension GL_GOOGLE_include_directive : require
#include "trace/beam.h"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

layout(constant_id = 0) const uint kEntriesPerWord = 0u; // of lists; 0: there are none

layout(local_size_x = kBeamGroup) in;
layout(push_constant, scalar) uniform Push
{
    BeamMarkParams params;
};

// Bits of the four cells of a row inside their 4x4x4 block; yz holds the row's lower two bits of y and z.
uint rowOfBlock(uvec2 half_mask_and_shift)
{
    uint low = (half_mask_and_shift.x >> half_mask_and_shift.y) & 3u;         // x 0, 1
    uint high = (half_mask_and_shift.x >> (half_mask_and_shift.y + 8u)) & 3u; // x 2, 3
    return low | (high << 2);
}

void main()
{
    uint row = threadIndex();
    if (row >= params.cells * params.cells)
        return;
    uvec3 cell = uvec3(0u, row % params.cells, row / params.cells);
    uint64_t bits = 0ul;
    for (cell.x = 0u; cell.x < params.cells; cell.x += 4u)
    {
        uint node = 0u;
        bool present = true;
        uint block = 0u;
        for (uint level = 0u; level < params.levels; ++level)
        {
            uint c = cellInBlock(cell >> (2u * (params.levels - 1u - level)));
            Node n = params.nodes.data[present ? node : 0u];
            uint mask = c < 32u ? n.mask_lo : n.mask_hi;
            uint below = c & 31u;
            block = present ? rowOfBlock(uvec2(mask, below)) : 0u;
            present = present && hasChild(n, c);
            node = childIndex(n, c);
            if (kEntriesPerWord != 0u && present)
                node = listedChild(params.nodes, node, kEntriesPerWord);
        }
        bits |= uint64_t(block) << cell.x;
    }
    params.rows.data[row] = bits;
}
