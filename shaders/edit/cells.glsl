// SPDX-License-Identifier: MIT
// The cells of a dab (edit/edit.h), and which voxels its brush covers.
#ifndef ZVO_SHADERS_EDIT_CELLS_GLSL
#define ZVO_SHADERS_EDIT_CELLS_GLSL

#include "edit/edit.h"
#include "lib/node.glsl"

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

// Whether a voxel is in the box.
bool isInDab(EditBox box, uvec3 voxel)
{
    return all(greaterThanEqual(voxel, box.lo)) && all(lessThanEqual(voxel, box.hi));
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

// A cell of the base tree, without what only leaves have.
EditCell unchangedCell(uint base, uint voxels, uint rank, uvec2 mask)
{
    return EditCell(base, voxels, rank, mask.x, mask.y, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
}

// The voxel of a cell's base tree: the index of its attribute, kInteriorIndex, or kNoEditNode. The cell is a leaf.
uint baseVoxel(EditCell leaf, uint bit)
{
    Node surface = Node(leaf.surface_lo, leaf.voxels, leaf.surface_hi, leaf.voxels + bitCount(leaf.surface_lo));
    uint inside = hasCell(uvec2(leaf.before_lo, leaf.before_hi), bit) ? kInteriorIndex : kNoEditNode;
    return hasChild(surface, bit) ? childIndex(surface, bit) : inside;
}

uint shapeOf(Brush brush)
{
    return brush.kind & ((1u << kBrushActionShift) - 1u);
}

uint actionOf(Brush brush)
{
    return bitfieldExtract(brush.kind, int(kBrushActionShift), 8);
}

// The neighbour of a cell by a face: side / 2 is the axis, and odd sides are the upper ones.
uvec3 besideFace(uvec3 cell, uint side)
{
    return cell + uvec3(equal(uvec3(side >> 1), uvec3(0u, 1u, 2u))) * ((side & 1u) != 0u ? 1u : ~0u);
}

// The first and the last voxel of a dab's box before it was grown.
uvec3 boxLow(Brush brush, EditBox box)
{
    return box.lo + (uvec3(brush.kind) >> (kBrushGrownShift + uvec3(0u, 1u, 2u)) & 1u);
}

uvec3 boxHigh(Brush brush, EditBox box)
{
    return box.hi - (uvec3(brush.kind) >> (kBrushGrownShift + uvec3(3u, 4u, 5u)) & 1u);
}

// Of a sphere.
int radiusOf(Brush brush)
{
    return (brush.hi.x - brush.lo.x) >> 1;
}

bool isUnderBrush(Brush brush, uvec3 voxel)
{
    ivec3 at = ivec3(voxel);
    bool in_box = all(greaterThanEqual(at, brush.lo)) && all(lessThanEqual(at, brush.hi));
    int radius = radiusOf(brush);
    ivec3 near = min(abs(at - brush.lo - radius), radius + 1); // squares of large distances would overflow
    int square = near.x * near.x + near.y * near.y + near.z * near.z;
    return in_box && (shapeOf(brush) == kBrushBox || square <= radius * (radius + 1));
}

// The direction of the surface that a brush makes at a voxel: away from its middle; for a box, across the nearest side,
// or sides. Zero in the middle.
ivec3 brushNormal(Brush brush, uvec3 voxel)
{
    ivec3 from_lo = ivec3(voxel) - brush.lo;
    ivec3 from_hi = brush.hi - ivec3(voxel);
    ivec3 near = min(from_lo, from_hi);
    int nearest = min(near.x, min(near.y, near.z));
    ivec3 side = mix(ivec3(0), sign(from_lo - from_hi), equal(near, ivec3(nearest)));
    return shapeOf(brush) == kBrushBox ? side : from_lo - radiusOf(brush);
}

#endif
