#version 460
// SPDX-License-Identifier: MIT
// Flags the nodes of a level that contain fragments: a thread a fragment goes down from the root.
#extension GL_GOOGLE_include_directive : require
#include "baseline/crassin_green.glsl"
#include "lib/dispatch.glsl"

void main()
{
    uint index = threadIndex();
    if (index >= params.fragment_count)
        return;
    uint node = nodeOf(params.fragments.data[index], params.level);
    if (node != kNoNode && params.nodes.data[node].child == 0u)
        atomicOr(params.nodes.data[node].child, kPointerFlagged);
}
