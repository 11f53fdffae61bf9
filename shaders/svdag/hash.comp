#version 460
// SPDX-License-Identifier: MIT
// Computes a hash of 64 bits of each inner node of a level, from its mask and the classes of its children.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"
#define LISTS_CONSTANT_ID 0
#include "lib/dispatch.glsl"
#include "svdag/candidate.glsl"
#include "svdag/class_hash.glsl"

layout(local_size_x = kSvdagGroup) in;
layout(push_constant, scalar) uniform Push
{
    ClassHashParams params;
};

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    Node node = params.nodes.data[params.first_node + index];
    uint count = childCount(node);
    uvec2 hash = uvec2(hashMask(node.mask_lo, node.mask_hi), hashMask(node.mask_hi, node.mask_lo));
    for (uint i = 0u; i < count; ++i)
    {
        uint child_class = params.classes.data[childAt(node, params.nodes, i)];
        // Two chains, so that no common change of several children leaves both unchanged.
        hash.x = mixBits(hash.x + child_class);
        hash.y = (hash.y ^ child_class) * 0x01000193u;
        hash.y ^= hash.y >> 15;
    }
    params.hashes.data[index] = hash & params.hash_mask;
}
