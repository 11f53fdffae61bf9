// SPDX-License-Identifier: MIT
// The units of nodes (algebra/algebra.h). Needs GPU_ENTRY with UnitsParams.
#ifndef ZVO_SHADERS_ALGEBRA_UNIT_MASKS_GLSL
#define ZVO_SHADERS_ALGEBRA_UNIT_MASKS_GLSL

#include "algebra/operand.glsl"
#include "algebra/shifts.glsl"

// The cells of a node that are matter.
uvec2 matterOf(uint number)
{
    bool is_inner = number < params.inner_count;
    uint reference = is_inner ? number : kLeafWords + number + params.inner_count;
    uvec2 mask = nodeMask(params.tree.nodes, reference);
    if (is_inner && !kBackground)
        mask = isFullNode(params.tree.nodes.data[number].base_lo) ? mask : uvec2(0u);
    return kBackground ? ~mask : mask;
}

bool isAny(uvec2 mask)
{
    return (mask.x | mask.y) != 0u;
}

uint countOf(uvec2 mask)
{
    return bitCount(mask.x) + bitCount(mask.y);
}

// The unit of a cell that is matter. A loop of at most 63 iterations.
uvec2 unitAround(uint cell, uvec2 matter)
{
    uvec2 unit = cellBit(cell);
    for (uvec2 grown = spreadInBlock(unit, kCorners) & matter; grown != unit;
         grown = spreadInBlock(unit, kCorners) & matter)
        unit = grown;
    return unit;
}

// The number of the unit whose lowest cell is given.
uint unitNumber(uint node, uint first)
{
    uvec2 before = params.firsts.data[node] & ~cellsFrom(first);
    return 1u + params.ranks.data[node].y + countOf(before);
}

#endif
