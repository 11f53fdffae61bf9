#version 460
// SPDX-License-Identifier: MIT
// Finds which children the cells of a level have after the dab. A node that has lost all children is removed.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"
#include "edit/cells.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    EditParentsParams params;
};

void main()
{
    uint number = threadIndex();
    if (number >= levelCellCount(params.box, params.level))
        return;
    uint index = firstCell(params.box, params.level) + number;
    uint first_child = firstCell(params.box, params.level + 1u);
    uvec3 corner = 4u * cellOf(params.box, params.level, number);
    EditCell cell = params.cells.data[index];
    for (uint bit = 0u; bit < 64u; ++bit)
    {
        uvec3 position = corner + cellAt(bit);
        if (isInBox(params.box, params.level + 1u, position))
        {
            EditCell child = params.cells.data[first_child + cellNumber(params.box, params.level + 1u, position)];
            uint is_there = (child.mask_lo | child.mask_hi) != 0u ? 1u : 0u;
            uint is_lower = bit < 32u ? 1u : 0u;
            cell.mask_lo = (cell.mask_lo & ~(is_lower << (bit & 31u))) | ((is_lower & is_there) << (bit & 31u));
            cell.mask_hi = (cell.mask_hi & ~((1u - is_lower) << (bit & 31u))) |
                           (((1u - is_lower) & is_there) << (bit & 31u));
            cell.changed |= child.changed;
        }
    }
    params.cells.data[index] = cell;
}
