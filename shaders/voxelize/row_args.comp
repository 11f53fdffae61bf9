#version 460
// SPDX-License-Identifier: MIT
// How many workgroups voxelize/rows needs for the row blocks that were listed.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Push
{
    RowArgsParams params;
};

void main()
{
    uint blocks = min(params.counters.data[0].block_count, params.block_capacity);
    uint groups = (blocks * kBlockRows + kRowsGroup - 1u) / kRowsGroup;
    uint rows = (groups + params.max_groups_x - 1u) / params.max_groups_x;
    params.args.data[0] = DispatchArgs(rows > 1u ? params.max_groups_x : groups, rows, 1u);
}
