#version 460
// SPDX-License-Identifier: MIT
// Replaces the slot of each node of a level by its class.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(ClassResolveParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    uint self = params.first_node + index;
    params.classes.data[self] = params.table.data[params.classes.data[self]];
}
