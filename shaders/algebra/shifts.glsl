// SPDX-License-Identifier: MIT
// Masks of blocks of 4x4x4 cells, moved by a cell along an axis. up: to higher coordinates.
#ifndef ZVO_SHADERS_ALGEBRA_SHIFTS_GLSL
#define ZVO_SHADERS_ALGEBRA_SHIFTS_GLSL

#include "lib/cell_masks.glsl"

const uint kCellsX02 = kCellsX0 | (kCellsX0 << 8);  // x is 0 or 2
const uint kCellsY02 = kCellsY0 | (kCellsY0 << 16);

// What stays in the block.
uvec2 movedUp(uvec2 m, uint axis)
{
    if (axis == 0u)
        return ((m & kCellsX02) << 1) | ((m & (kCellsX0 << 1)) << 7);
    if (axis == 1u)
        return ((m & kCellsY02) << 2) | ((m & (kCellsY0 << 2)) << 14);
    return uvec2((m.x & kCellsZ0) << 4, ((m.y & kCellsZ0) << 4) | ((m.x >> 4) & kCellsZ0));
}

uvec2 movedDown(uvec2 m, uint axis)
{
    if (axis == 0u)
        return ((m >> 1) & kCellsX02) | ((m >> 7) & (kCellsX0 << 1));
    if (axis == 1u)
        return ((m >> 2) & kCellsY02) | ((m >> 14) & (kCellsY0 << 2));
    return uvec2(((m.x >> 4) & kCellsZ0) | ((m.y & kCellsZ0) << 4), (m.y >> 4) & kCellsZ0);
}

// What leaves the block, in the block beside it.
uvec2 leavingUp(uvec2 m, uint axis)
{
    if (axis == 0u)
        return (m >> 9) & kCellsX0;
    if (axis == 1u)
        return (m >> 18) & kCellsY0;
    return uvec2((m.y >> 4) & kCellsZ0, 0u);
}

uvec2 leavingDown(uvec2 m, uint axis)
{
    if (axis == 0u)
        return (m & kCellsX0) << 9;
    if (axis == 1u)
        return (m & kCellsY0) << 18;
    return uvec2(0u, (m.x & kCellsZ0) << 4);
}

// The cells of a block and their neighbours along an axis; below, above: the blocks beside it.
uvec2 spreadAlong(uvec2 m, uvec2 below, uvec2 above, uint axis)
{
    return m | movedUp(m, axis) | leavingUp(below, axis) | movedDown(m, axis) | leavingDown(above, axis);
}

// The cells of a block and their neighbours in it: across faces, or all.
uvec2 spreadInBlock(uvec2 m, bool corners)
{
    const uvec2 none = uvec2(0u);
    uvec2 x = spreadAlong(m, none, none, 0u);
    uvec2 y = spreadAlong(corners ? x : m, none, none, 1u);
    uvec2 z = spreadAlong(corners ? y : m, none, none, 2u);
    return corners ? z : x | y | z;
}

// What a block's cells touch in the block beside it. direction: -1, 0 or 1 along each axis.
uvec2 touchedBeside(uvec2 m, ivec3 direction, bool corners)
{
    [[unroll]] for (uint axis = 0u; axis < 3u; ++axis)
    {
        if (direction[axis] > 0)
            m = leavingUp(m, axis);
        else if (direction[axis] < 0)
            m = leavingDown(m, axis);
        else if (corners)
            m = spreadAlong(m, uvec2(0u), uvec2(0u), axis);
    }
    return m;
}

#endif
