#version 460
// SPDX-License-Identifier: MIT
// The voxels of a listed brick in the result of an operation that decides voxel by voxel.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(AlgebraParams, ALGEBRA_CONSTANTS);
layout(local_size_x = kAlgebraGroup) in;

#include "algebra/brick_masks.glsl"
#include "algebra/store_mask.glsl"
#include "lib/dispatch.glsl"

// The mask of cells of a leaf of a, present or not.
uvec2 keptMask(Found leaf)
{
    if (leaf.reference != kNothing && isLeafWord(leaf.reference))
        return params.masks.data[nodeIndexOf(params.a.leaf_groups, leaf.reference)];
    return hasKept(leaf) ? uvec2(~0u) : uvec2(0u);
}

void main()
{
    uint brick = workgroupIndex();
    if (brick >= params.counters.data[0].listed_count)
        return;
    uint entry = params.ranges.data[brick].entry;
    uvec3 corner = brickCell(keyOf(params.bricks.data[entry]), params.brick_levels);
    uvec3 leaf = 4u * corner + cellNumbered(gl_LocalInvocationIndex);
    Found found = findNode(params.a, leaf, params.brick_levels + 1u);
    uvec2 a = leafMask(params.a, found);
    uvec2 mask = a;
    if (kOperation == kKeep)
        mask = a & keptMask(found);
    else if (kOperation == kEnclose)
        mask = a | keptMask(found);
    else
    {
        uvec2 b = leafMask(params.b, findNode(params.b, leaf, params.brick_levels + 1u));
        mask = kOperation == kUnite ? a | b : kOperation == kIntersect ? a & b : a & ~b;
    }
    storeMask(brick, entry, mask);
}
