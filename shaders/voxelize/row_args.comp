#version 460
// SPDX-License-Identifier: MIT
// Computes how many workgroups the bands and row blocks need that have been listed so far.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"
#include "lib/dispatch_args.glsl"

layout(local_size_x = kArgsGroup) in;
layout(push_constant, scalar) uniform Push
{
    RowArgsParams params;
};

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    uint bands = min(params.counters.data[0].big_count, params.big_capacity);
    uint blocks = min(params.counters.data[0].block_count, params.block_capacity);
    params.args.data[0] = foldedArgs((bands + kBandsGroup - 1u) / kBandsGroup, params.max_groups_x);
    params.args.data[1] = foldedArgs((blocks * kBlockRows + kRowsGroup - 1u) / kRowsGroup, params.max_groups_x);
}
