#version 460
// SPDX-License-Identifier: MIT
// Puts the bricks of an operand into the table, and those beside them in which the result may differ from it.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(ListAlgebraParams, ALGEBRA_BRICKS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "algebra/operand.glsl"
#include "algebra/place.glsl"
#include "algebra/shifts.glsl"
#include "lib/dispatch.glsl"

#define BRICKS_BINDING 0
#include "lib/bricks.glsl"

void insert(uvec3 brick)
{
    bool claimed;
    if (brickFindOrInsert(brickKey(brick, params.brick_levels), claimed) == kNoEntry)
        atomicAdd(params.counters.data[0].overflow_count, 1u);
}

void main()
{
    if (threadIndex() >= params.node_count)
        return;
    uint number = params.first_node + threadIndex();
    Node node = params.tree.nodes.data[number];
    if (isFullNode(node.base_lo))
        return;
    uvec3 brick = unpackPlace(params.places.data[number]).cell;
    insert(brick);
    if (!kGrows && !kExposes)
        return;
    for (uint i = 0u; i < 27u; ++i)
    {
        ivec3 direction = ivec3(i % 3u, i / 3u % 3u, i / 9u) - 1;
        ivec3 beside = ivec3(brick) + direction;
        bool in_grid = all(greaterThanEqual(beside, ivec3(0))) && all(lessThan(beside, ivec3(params.brick_count)));
        uvec2 touched = touchedBeside(uvec2(node.mask_lo, node.mask_hi), direction, true);
        bool listed = kGrows && in_grid && (touched.x | touched.y) != 0u;
        if (kExposes && in_grid && !listed)
            listed = isFullBelow(params.a, findNode(params.a, uvec3(beside), params.brick_levels).reference);
        if (i != 13u && listed) // the brick itself
            insert(uvec3(beside));
    }
}
