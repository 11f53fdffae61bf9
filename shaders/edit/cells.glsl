// SPDX-License-Identifier: MIT
// The cells of a dab (edit/edit.h), and which voxels its brush covers.
#ifndef ZVO_SHADERS_EDIT_CELLS_GLSL
#define ZVO_SHADERS_EDIT_CELLS_GLSL

#include "edit/edit.h"

// The shift from coordinates of voxels to those of a level's cells.
uint levelShift(EditBox box, uint level)
{
    return 2u * (box.level_count - level);
}

uvec3 levelSize(EditBox box, uint level)
{
    uint shift = levelShift(box, level);
    return (box.hi >> shift) - (box.lo >> shift) + 1u;
}

uint levelCellCount(EditBox box, uint level)
{
    uvec3 size = levelSize(box, level);
    return size.x * size.y * size.z;
}

uint firstCell(EditBox box, uint level)
{
    uint first = 0u;
    for (uint l = 0u; l < level; ++l)
        first += levelCellCount(box, l);
    return first;
}

bool isInBox(EditBox box, uint level, uvec3 cell)
{
    uint shift = levelShift(box, level);
    return all(greaterThanEqual(cell, box.lo >> shift)) && all(lessThanEqual(cell, box.hi >> shift));
}

// Number, among those of its level, of a cell of the box.
uint cellNumber(EditBox box, uint level, uvec3 cell)
{
    uvec3 at = cell - (box.lo >> levelShift(box, level));
    uvec3 size = levelSize(box, level);
    return at.x + size.x * (at.y + size.y * at.z);
}

// Coordinates of a cell by its number among those of its level.
uvec3 cellOf(EditBox box, uint level, uint number)
{
    uvec3 size = levelSize(box, level);
    return (box.lo >> levelShift(box, level)) +
           uvec3(number % size.x, number / size.x % size.y, number / (size.x * size.y));
}

// Level of a cell by its number among all. Past the last one: level_count.
uint levelOf(EditBox box, inout uint number)
{
    uint level = 0u;
    for (uint count = levelCellCount(box, 0u); level < box.level_count && number >= count;)
    {
        number -= count;
        ++level;
        count = level < box.level_count ? levelCellCount(box, level) : 0u;
    }
    return level;
}

bool isUnderBrush(Brush brush, uvec3 voxel)
{
    ivec3 away = abs(ivec3(voxel) - brush.center);
    int radius = int(brush.radius);
    bool in_box = max(away.x, max(away.y, away.z)) <= radius;
    ivec3 near = min(away, radius + 1); // squares of large distances would overflow
    int square = near.x * near.x + near.y * near.y + near.z * near.z;
    return in_box && (brush.shape == kBrushBox || square <= radius * (radius + 1));
}

// The direction of the surface that a brush makes at a voxel: away from its centre; for a box, across the nearest side.
ivec3 brushNormal(Brush brush, uvec3 voxel)
{
    ivec3 away = ivec3(voxel) - brush.center;
    ivec3 size = abs(away);
    int most = max(size.x, max(size.y, size.z));
    ivec3 side = ivec3(size.x == most ? away.x : 0, size.y == most ? away.y : 0, size.z == most ? away.z : 0);
    return brush.shape == kBrushBox ? side : away;
}

#endif
