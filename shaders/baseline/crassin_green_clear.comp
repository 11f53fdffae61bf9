#version 460
// SPDX-License-Identifier: MIT
// Empties the nodes of a level that have been allocated.
#extension GL_GOOGLE_include_directive : require
#include "baseline/crassin_green.glsl"
#include "lib/dispatch.glsl"

void main()
{
    LevelRange range = params.ranges.data[params.level];
    uint index = threadIndex();
    if (index < range.count)
        params.nodes.data[range.first + index] = PointerNode(0u, 0u, 0u);
}
