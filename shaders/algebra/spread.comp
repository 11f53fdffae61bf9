#version 460
// SPDX-License-Identifier: MIT
// The voxels of a listed brick after dilation or erosion by a voxel. An erosion is a dilation of what is empty.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(AlgebraParams, ALGEBRA_CONSTANTS);
layout(local_size_x = kAlgebraGroup) in;

#include "algebra/brick_masks.glsl"
#include "algebra/leaves_around.glsl"
#include "algebra/shifts.glsl"
#include "algebra/store_mask.glsl"
#include "lib/dispatch.glsl"

// Masks of the leaves of the brick and around it.
shared uvec2 s_masks[kLeavesAround];
shared uint s_bricks[27]; // references of the brick and those around it

void findBricks(uvec3 brick)
{
    uint i = gl_LocalInvocationIndex;
    if (i >= 27u)
        return;
    ivec3 at = ivec3(brick) + ivec3(i % 3u, i / 3u % 3u, i / 9u) - 1;
    uint reference = kNothing;
    if (all(greaterThanEqual(at, ivec3(0))) && all(lessThan(4 * at, ivec3(params.leaf_count))))
        reference = findNode(params.a, uvec3(at), params.brick_levels).reference;
    s_bricks[i] = reference;
}

// The mask of a leaf by its coordinates from the lowest one around the brick on. Cells outside of the grid spread
// nothing.
uvec2 leafAround(uvec3 brick, uvec3 at)
{
    ivec3 place = ivec3(4u * brick + at) - 1;
    if (any(lessThan(place, ivec3(0))) || any(greaterThanEqual(place, ivec3(params.leaf_count))))
        return uvec2(0u);
    uint reference = s_bricks[brickOfLeafAround(at)];
    uvec2 mask = uvec2(0u);
    if (reference != kNothing)
    {
        Node node = loadInner(params.a.nodes, reference);
        uint cell = cellInBlock(at + 3u);
        if (hasChild(node, cell))
            mask = nodeMask(params.a.nodes, childIndex(node, cell));
    }
    return kOperation == kErode ? ~mask : mask;
}

uvec2 maskAt(ivec3 at)
{
    return s_masks[leafAroundNumber(uvec3(at))];
}

// The leaf at a place, with what reaches it along z, or along y and z.
uvec2 spreadColumn(ivec3 at)
{
    return spreadAlong(maskAt(at), maskAt(at - ivec3(0, 0, 1)), maskAt(at + ivec3(0, 0, 1)), 2u);
}

uvec2 spreadLayer(ivec3 at)
{
    return spreadAlong(spreadColumn(at), spreadColumn(at - ivec3(0, 1, 0)), spreadColumn(at + ivec3(0, 1, 0)), 1u);
}

uvec2 spreadLeaf(ivec3 at)
{
    if (kCorners)
        return spreadAlong(spreadLayer(at), spreadLayer(at - ivec3(1, 0, 0)), spreadLayer(at + ivec3(1, 0, 0)), 0u);
    uvec2 along_x = spreadAlong(maskAt(at), maskAt(at - ivec3(1, 0, 0)), maskAt(at + ivec3(1, 0, 0)), 0u);
    uvec2 along_y = spreadAlong(maskAt(at), maskAt(at - ivec3(0, 1, 0)), maskAt(at + ivec3(0, 1, 0)), 1u);
    return along_x | along_y | spreadColumn(at);
}

void main()
{
    uint brick = workgroupIndex();
    if (brick >= params.counters.data[0].listed_count)
        return;
    uint entry = params.ranges.data[brick].entry;
    uvec3 cell = brickCell(keyOf(params.bricks.data[entry]), params.brick_levels);
    findBricks(cell);
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < kLeavesAround; i += kAlgebraGroup)
        s_masks[i] = leafAround(cell, leafAroundPlace(i));
    barrier();
    uvec2 mask = spreadLeaf(ivec3(cellNumbered(gl_LocalInvocationIndex)) + 1);
    mask = kOperation == kErode ? ~mask : mask;
    bool in_grid = all(lessThan(4u * cell + cellNumbered(gl_LocalInvocationIndex), uvec3(params.leaf_count)));
    storeMask(brick, entry, in_grid ? mask : uvec2(0u));
}
