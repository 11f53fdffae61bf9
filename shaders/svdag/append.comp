#version 460
// SPDX-License-Identifier: MIT
// Copies inner nodes of a level of one DAG, with their lists, behind those of another that has two entries a word.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(AppendParams, SVDAG_APPEND_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"
#include "lib/node.glsl"

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    Node node = params.from.data[params.first_from + index];
    uint flags = node.base_lo & kListFlags;
    uint from = node.base_lo & ~kListFlags;
    uint to = from + params.entry_shift;
    uint low = bitCount(node.mask_lo);
    uint count = low + bitCount(node.mask_hi);
    for (uint i = 0u; i < count; ++i)
    {
        uint child = listEntry(uint64_t_ConstPtr(uint64_t(params.from)), from + i, kEntriesPerWord);
        params.to_entries.data[to + i] = child + params.child_shift;
    }
    params.to.data[params.first_to + index] =
        Node(node.mask_lo, flags | to, node.mask_hi, flags | (to + low));
}
