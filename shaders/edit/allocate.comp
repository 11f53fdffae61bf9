#version 460
// SPDX-License-Identifier: MIT
// Finds which children the cells have after the dab, level by level from the leaves up; a node that has lost all
// children is removed. Then allocates the children, or voxels, of changed cells, in the order of cells. All by one
// workgroup.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditAllocateParams, EDIT_ALLOCATE_CONSTANTS);
layout(local_size_x_id = 1) in;

#include "edit/cells.glsl"
#include "lib/morton.glsl"

#define SCAN_GROUP gl_WorkGroupSize.x
#include "lib/scan.glsl"

// Tells the parents of a level's changed cells that they change, and whether the cells still have nodes. The parents of
// others know: their masks are those before the dab.
void tellParents(uint level)
{
    uint first_cell = firstCell(params.box, level);
    uint first_parent = firstCell(params.box, level - 1u);
    uint cell_count = levelCellCount(params.box, level);
    for (uint number = gl_LocalInvocationIndex; number < cell_count; number += gl_WorkGroupSize.x)
    {
        EditCell cell = params.cells.data[first_cell + number];
        if (cell.changed != 0u)
        {
            uvec3 position = cellOf(params.box, level, number);
            uint parent = first_parent + cellNumber(params.box, level - 1u, position >> 2);
            uint child = cellInBlock(position);
            uint bit = 1u << (child & 31u);
            bool is_there = (cell.mask_lo | cell.mask_hi) != 0u;
            uvec2 bits = child < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
            if (is_there)
            {
                atomicOr(params.cells.data[parent].mask_lo, bits.x);
                atomicOr(params.cells.data[parent].mask_hi, bits.y);
            }
            else
            {
                atomicAnd(params.cells.data[parent].mask_lo, ~bits.x);
                atomicAnd(params.cells.data[parent].mask_hi, ~bits.y);
            }
            atomicOr(params.cells.data[parent].changed, 1u);
        }
    }
}

// What a cell takes room for. Adds up how many voxels the dab makes.
uint childCount(uint cell_index, uint end, bool are_leaves, inout uint more)
{
    EditCell cell = params.cells.data[min(cell_index, end - 1u)]; // unconditionally, so that four loads are under way
    bool is_cell = cell_index < end;
    more += is_cell && are_leaves ? cell.first : 0u;
    bool takes_room = is_cell && !(are_leaves && !kAttributes);
    return takes_room ? cell.changed * (bitCount(cell.mask_lo) + bitCount(cell.mask_hi)) : 0u;
}

// Allocates the children of cells from `top` on, which becomes the end of what they take.
void allocate(uint first, uint end, bool are_leaves, inout uint top, inout uint more)
{
    for (uint round = first; round < end; round += 4u * gl_WorkGroupSize.x)
    {
        uint cell = round + 4u * gl_LocalInvocationIndex;
        uvec4 counts = uvec4(childCount(cell, end, are_leaves, more), childCount(cell + 1u, end, are_leaves, more),
                             childCount(cell + 2u, end, are_leaves, more),
                             childCount(cell + 3u, end, are_leaves, more));
        uint total;
        uint child = top + workgroupExclusiveAdd(counts.x + counts.y + counts.z + counts.w, total);
        [[unroll]] for (uint i = 0u; i < 4u; ++i)
        {
            if (cell + i < end)
                params.cells.data[cell + i].first = child;
            child += counts[i];
        }
        top += total;
    }
}

void main()
{
    for (uint level = params.box.level_count - 1u; level > 0u; --level)
    {
        tellParents(level);
        memoryBarrierBuffer();
        barrier();
    }
    EditState from = params.states.data[params.from];
    EditState kept = params.states.data[params.kept];
    uint node_top = max(from.node_top, kept.node_top);
    // A word of the emission table belongs to a single dab.
    uint voxel_top = (max(from.voxel_top, kept.voxel_top) + 31u) & ~31u;
    uint my_more = 0u;
    allocate(0u, params.inner_count, false, node_top, my_more);
    allocate(params.inner_count, params.cell_count, true, voxel_top, my_more);
    uint more;
    workgroupExclusiveAdd(my_more, more);
    if (gl_LocalInvocationIndex == 0u)
    {
        bool fits = node_top <= params.node_end && voxel_top <= params.voxel_end;
        params.states.data[params.to] = EditState(fits ? node_top : from.node_top, fits ? voxel_top : from.voxel_top,
                                                  from.voxel_count + (fits ? more : 0u), fits ? 0u : 1u);
    }
}
