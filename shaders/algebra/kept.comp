#version 460
// SPDX-License-Identifier: MIT
// The cells of each node that are kept: those of large components; of the background, those that are enclosed.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(UnitsParams, ALGEBRA_UNITS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "algebra/unit_masks.glsl"
#include "lib/dispatch.glsl"

bool isKept(uint root)
{
    if (kBackground)
        return root != 0u;
    uvec2 size = uvec2(params.sizes.data[root].size_lo, params.sizes.data[root].size_hi);
    uvec2 least = uvec2(params.least_lo, params.least_hi);
    bool is_equal = size == least;
    bool is_more = size.y != least.y ? size.y > least.y : size.x > least.x;
    return is_equal ? root <= params.last_root : is_more;
}

void main()
{
    uint number = threadIndex();
    if (number >= params.node_count)
        return;
    uvec2 matter = matterOf(number);
    uvec2 kept = uvec2(0u);
    for (uvec2 rest = matter; isAny(rest);)
    {
        uint first = firstCell(rest);
        uvec2 unit = unitAround(first, matter);
        rest &= ~unit;
        if (isKept(params.labels.data[unitNumber(number, first)]))
            kept |= unit;
    }
    params.kept.data[number] = kept;
}
