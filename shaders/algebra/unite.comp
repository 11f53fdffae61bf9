#version 460
// SPDX-License-Identifier: MIT
// Unites the units of a node with those that they touch in one direction. What stands there on the level of the node,
// or above it, is looked at; nodes below it look this way themselves.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(UnitsParams, ALGEBRA_UNITS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "algebra/place.glsl"
#include "algebra/unit_masks.glsl"
#include "lib/dispatch.glsl"

uint g_steps = kUnionSteps; // that are left

// Gives two units the same root, the lower one. Labels only ever become lower.
void unite(uint a, uint b)
{
    for (; a != b && g_steps != 0u; --g_steps)
    {
        uint low = min(a, b);
        uint high = max(a, b);
        uint was = atomicMin(params.labels.data[high], low);
        a = was == high ? low : was;
        b = low;
    }
    if (a != b)
        atomicAdd(params.counts.data[0].unfinished, 1u);
}

// The unit of a cell of a node.
uint unitAt(uint node, uint cell)
{
    return unitNumber(node, firstCell(unitAround(cell, matterOf(node))));
}

// Unites the units of a node that reach into the block beside it with one unit.
void uniteAll(uint number, uvec2 matter, ivec3 direction, uint with)
{
    for (uvec2 rest = matter; isAny(rest);)
    {
        uint first = firstCell(rest);
        uvec2 unit = unitAround(first, matter);
        rest &= ~unit;
        if (isAny(touchedBeside(unit, direction, kCorners)))
            unite(unitNumber(number, first), with);
    }
}

// Unites them with those of the node beside it.
void uniteEach(uint number, uvec2 matter, ivec3 direction, uint other)
{
    uvec2 beside = matterOf(other);
    for (uvec2 rest = matter; isAny(rest);)
    {
        uint first = firstCell(rest);
        uvec2 unit = unitAround(first, matter);
        rest &= ~unit;
        for (uvec2 touched = touchedBeside(unit, direction, kCorners) & beside; isAny(touched);)
        {
            uvec2 with = unitAround(firstCell(touched), beside);
            touched &= ~with;
            unite(unitNumber(number, first), unitNumber(other, firstCell(with)));
        }
    }
}

void main()
{
    uint number = threadIndex();
    if (number >= params.node_count)
        return;
    uvec2 matter = matterOf(number);
    ivec3 direction = ivec3(params.direction & 3u, (params.direction >> 2) & 3u, params.direction >> 4) - 1;
    if (!isAny(touchedBeside(matter, direction, kCorners)))
        return;
    NodePlace place = unpackPlace(params.places.data[number]);
    ivec3 cell = ivec3(place.cell) + direction;
    if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, ivec3(1 << (2u * place.level)))))
    {
        if (kBackground)
            uniteAll(number, matter, direction, 0u);
        return;
    }
    Found found = findNode(params.tree, uvec3(cell), place.level);
    if (found.reference == kNothing || isFullNode(found.reference))
    {
        if (kBackground == (found.reference == kNothing))
            uniteAll(number, matter, direction, unitAt(found.around, found.cell));
        return;
    }
    bool is_forward = params.direction > 21u; // the middle of the 27, which is no direction
    if (is_forward)
        uniteEach(number, matter, direction, nodeIndexOf(params.tree.leaf_groups, found.reference));
}
