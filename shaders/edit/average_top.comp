#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the changed nodes of all levels but, where a dab touches many leaves, theirs: one workgroup
// takes level after level, from the lowest of them up to the root.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditAverageTopParams, EDIT_AVERAGE_TOP_CONSTANTS);
layout(local_size_x_id = 1) in;

#include "edit/cells.glsl"

#define AVERAGE_CHILDREN Attribute_Ptr
#include "edit/average.glsl"
#include "lib/average.glsl"

void main()
{
    for (uint level = params.level_count; level-- > 0u;)
    {
        uint first_cell = firstCell(params.box, level);
        uint cell_count = levelCellCount(params.box, level);
        bool are_leaves = level + 1u == params.box.level_count;
        Attribute_Ptr children = Attribute_Ptr(are_leaves ? uint64_t(params.voxels) : uint64_t(params.averages));
        for (uint first = 0u; first < cell_count; first += kNodesGroup)
        {
            uint number = first + nodeOfGroup();
            averageCell(first_cell + number, number < cell_count, children, are_leaves ? 0u : params.attribute_offset);
        }
        memoryBarrierBuffer();
        barrier();
    }
}
