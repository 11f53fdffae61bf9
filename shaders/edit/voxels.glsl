// SPDX-License-Identifier: MIT
// The voxels of changed leaves, one a thread. Needs GPU_ENTRY with EditVoxelsParams, and kStamp.
#ifndef ZVO_SHADERS_EDIT_VOXELS_GLSL
#define ZVO_SHADERS_EDIT_VOXELS_GLSL

#include "edit/cells.glsl"
#include "edit/edit.h"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

layout(local_size_x = kEditGroup) in;

// A voxel of a changed leaf.
struct EditVoxel
{
    bool exists;
    uint index; // of its attribute
    uint base;  // of its attribute in the base tree; kInteriorIndex, or kNoEditNode
    uvec3 cell; // in the grid
    uint leaf;  // its number among the cells that are leaves
    uint bit;   // its cell in the leaf
    uint around; // of the node attributes that it looks like if it is inside
};

EditVoxel editVoxel()
{
    uint number = workgroupIndex();
    uint bit = gl_LocalInvocationIndex;
    EditVoxel voxel = EditVoxel(false, 0u, kNoEditNode, uvec3(0u), number, bit, 0u);
    if (number < levelCellCount(params.box, params.box.level_count - 1u) &&
        params.states.data[params.to].failed == 0u)
    {
        EditCell cell = params.cells.data[params.inner_count + number];
        Node leaf = Node(cell.mask_lo, cell.first, cell.mask_hi, cell.first + bitCount(cell.mask_lo));
        voxel.exists = cell.changed != 0u && hasChild(leaf, bit);
        voxel.index = childIndex(leaf, bit);
        voxel.cell = 4u * cellOf(params.box, params.box.level_count - 1u, number) + cellNumbered(bit);
        voxel.base = baseVoxel(cell, bit);
        voxel.around = cell.rank;
    }
    return voxel;
}

// Whether the voxel is to look like that of the stamp.
bool isStamped(EditVoxel voxel)
{
    bool can_be = kStamp && isInDab(params.box, voxel.cell) && actionOf(params.brush) != kBrushCarve;
    return can_be && ((params.stamp.data[stampMask(voxel.leaf, voxel.bit)] >> (voxel.bit & 31u)) & 1u) != 0u;
}

// Whether the voxel, which was there before, gets the look of the brush.
bool isPainted(EditVoxel voxel)
{
    bool can_be = !kStamp && isInDab(params.box, voxel.cell) && actionOf(params.brush) == kBrushPaint;
    return can_be && isUnderBrush(params.brush, voxel.cell);
}

#endif
