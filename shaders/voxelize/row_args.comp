#version 460
// SPDX-License-Identifier: MIT
// How many workgroups the bands and row blocks need that have been listed so far.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"

layout(local_size_x = kArgsGroup) in;
layout(push_constant, scalar) uniform Push
{
    RowArgsParams params;
};

DispatchArgs argsOf(uint groups)
{
    uint rows = (groups + params.max_groups_x - 1u) / params.max_groups_x;
    return DispatchArgs(rows > 1u ? params.max_groups_x : groups, rows, 1u);
}

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    uint bands = min(params.counters.data[0].big_count, params.big_capacity);
    uint blocks = min(params.counters.data[0].block_count, params.block_capacity);
    params.args.data[0] = argsOf((bands + kBandsGroup - 1u) / kBandsGroup);
    params.args.data[1] = argsOf((blocks * kBlockRows + kRowsGroup - 1u) / kRowsGroup);
}
