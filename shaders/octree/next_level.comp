#version 460
// SPDX-License-Identifier: MIT
// Sets the range of work items of the level that was just listed, and the number of workgroups for it.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#include "lib/dispatch_args.glsl"

layout(local_size_x = kArgsGroup) in;
layout(push_constant, scalar) uniform Push
{
    NextLevelParams params;
};

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    uint first = 0u;
    if (params.height != 0u)
        first = params.ranges.data[params.height - 1u].first + params.ranges.data[params.height - 1u].count;
    uint count = params.counters.data[0].node_count - first;
    params.ranges.data[params.height] = LevelRange(first, count);
    params.args.data[params.height] = foldedArgs((count + kNodesGroup - 1u) / kNodesGroup, params.max_groups_x);
}
