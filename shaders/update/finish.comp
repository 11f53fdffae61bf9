#version 460
// SPDX-License-Identifier: MIT
// Shows the overlay's root, or the last root if something had no room, and writes the result of the update.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(FinishParams, UPDATE_FINISH_CONSTANTS);
layout(local_size_x = kArgsGroup) in;

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    UpdateStatus status = params.state.data[0].status;
    status.touched_count = params.counters.data[0].node_count;
    if ((status.max_fragments >> params.sum_shift) > kFragmentsMax)
        status.failed |= kFailedFragments;
    uint root = params.root;
    if (status.failed != 0u)
        root = params.last_root != kNoNode ? params.last_root : params.roots.data[params.last_slot];
    params.roots.data[params.slot] = root;
    params.nodes.data[0] = params.nodes.data[root];
    if (kAttributes)
        params.node_attributes.data[0] = params.node_attributes.data[root + params.attribute_offset];
    params.results.data[params.slot] = status;
}
