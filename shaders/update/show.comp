#version 460
// SPDX-License-Identifier: MIT
// Shows the root of an earlier entry of the history.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(ShowParams, UPDATE_SHOW_CONSTANTS);
layout(local_size_x = kArgsGroup) in;

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    uint root = params.root != kNoNode ? params.root : params.roots.data[params.slot];
    params.nodes.data[0] = params.nodes.data[root];
    if (kAttributes)
        params.node_attributes.data[0] = params.node_attributes.data[root + params.attribute_offset];
}
