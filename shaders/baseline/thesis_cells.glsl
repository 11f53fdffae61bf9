// SPDX-License-Identifier: MIT
// The dense cells of a level and their eight children each.
// Needs kVoxels, params.voxels, params.children, params.first_cell, params.cell_count, params.first_child and
// params.child_count.
#ifndef ZVO_SHADERS_BASELINE_THESIS_CELLS_GLSL
#define ZVO_SHADERS_BASELINE_THESIS_CELLS_GLSL

#include "baseline/pointer_octree.h"
#include "shared/octree.h"

// Whether something is at a child of the level below, which lies between the first and the last that is occupied.
bool isOccupied(uint child)
{
    bool inside = child - params.first_child < params.child_count;
    uint i = inside ? child : params.first_child;
    uint word = kVoxels ? params.voxels.data[i].color : params.children.data[i].child;
    return inside && word != 0u;
}

PointerNode loadChild(uint child)
{
    PointerNode node = PointerNode(0u, 0u, 0u);
    if (child - params.first_child < params.child_count)
    {
        if (kVoxels)
        {
            Attribute voxel = params.voxels.data[child];
            node = PointerNode(voxel.color != 0u ? kPointerVoxel : 0u, voxel.color, voxel.normal);
        }
        else
        {
            node = params.children.data[child];
        }
    }
    return node;
}

#endif
