#version 460
// SPDX-License-Identifier: MIT
// Of a filled result, the voxels of a listed brick that have attributes: those that have them in an operand, and those
// beside an empty voxel.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(AlgebraParams, ALGEBRA_CONSTANTS);
layout(local_size_x = kAlgebraGroup) in;

#include "algebra/brick_masks.glsl"
#include "algebra/shifts.glsl"
#include "lib/dispatch.glsl"

#define BRICKS_BINDING 0
#include "lib/bricks.glsl"

// The result in a leaf of a listed brick.
uvec2 resultMask(uint brick, uint leaf)
{
    return params.inside.data[brick * (2u * kBrickLeaves) + leaf];
}

// The result in the leaf beside one; the border of the grid exposes nothing.
uvec2 maskBeside(uint brick, ivec3 corner, ivec3 leaf)
{
    ivec3 place = 4 * corner + leaf;
    if (any(lessThan(place, ivec3(0))) || any(greaterThanEqual(place, ivec3(params.leaf_count))))
        return uvec2(~0u);
    ivec3 beside = corner + (leaf >> 2);
    uint cell = cellInBlock(uvec3(leaf) & 3u);
    if (beside == corner)
        return resultMask(brick, cell);
    BrickEntry entry;
    if (brickFind(brickKey(uvec3(beside), params.brick_levels), entry) != kNoEntry)
        return resultMask(entry.mask_lo, cell);
    return isFullUnlisted(uvec3(beside)) ? uvec2(~0u) : uvec2(0u);
}

void main()
{
    uint brick = workgroupIndex();
    if (brick >= params.counters.data[0].listed_count)
        return;
    BrickEntry entry = params.bricks.data[params.ranges.data[brick].entry];
    ivec3 corner = ivec3(brickCell(keyOf(entry), params.brick_levels));
    ivec3 leaf = ivec3(cellNumbered(gl_LocalInvocationIndex));
    uvec2 mask = resultMask(brick, gl_LocalInvocationIndex);
    uvec2 empty = uvec2(0u); // voxels beside an empty one
    [[unroll]] for (uint axis = 0u; axis < 3u; ++axis)
    {
        ivec3 step = ivec3(equal(uvec3(axis), uvec3(0u, 1u, 2u)));
        empty |= spreadAlong(~mask, ~maskBeside(brick, corner, leaf - step), ~maskBeside(brick, corner, leaf + step),
                             axis);
    }
    uvec3 place = uvec3(4 * corner + leaf);
    uint levels = params.brick_levels + 1u;
    uvec2 surface = surfaceMask(params.a, findNode(params.a, place, levels));
    if (kOperation == kUnite || kOperation == kIntersect)
        surface |= surfaceMask(params.b, findNode(params.b, place, levels));
    params.brick_masks.data[brick * kBrickLeaves + gl_LocalInvocationIndex] = mask & (surface | empty);
}
