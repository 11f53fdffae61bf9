#version 460
// SPDX-License-Identifier: MIT
// Finds the units of each node.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(UnitsParams, ALGEBRA_UNITS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "algebra/unit_masks.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint number = threadIndex();
    if (number >= params.node_count)
        return;
    uvec2 matter = matterOf(number);
    uvec2 firsts = uvec2(0u);
    for (uvec2 rest = matter; isAny(rest);)
    {
        uint first = firstCell(rest);
        firsts |= cellBit(first);
        rest &= ~unitAround(first, matter);
    }
    params.firsts.data[number] = firsts;
    uint count = countOf(firsts);
    params.ranks.data[number] = uvec2(count < 32u ? (1u << count) - 1u : ~0u, 0u);
}
