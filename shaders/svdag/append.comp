#version 460
// SPDX-License-Identifier: MIT
// Copies inner nodes of a level of one DAG, with their lists, behind those of another.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"
#include "lib/dispatch.glsl"

layout(local_size_x = kSvdagGroup) in;
layout(push_constant, scalar) uniform Push
{
    AppendParams params;
};

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    Node node = params.from.data[params.first_from + index];
    uint from = node.base_lo & ~kChildList;
    uint to = from + params.word_shift;
    uint low = bitCount(node.mask_lo);
    uint count = low + bitCount(node.mask_hi);
    for (uint i = 0u; i < count; ++i)
        params.to_words.data[to + i] = params.from_words.data[from + i] + params.child_shift;
    params.to.data[params.first_to + index] = Node(node.mask_lo, kChildList | to, node.mask_hi, kChildList | (to + low));
}
