#version 460
// SPDX-License-Identifier: MIT
// Computes a hash of 64 bits of each inner node of a level, from its mask and the classes of its children.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(ClassHashParams, SVDAG_HASH_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"
#include "lib/sampling.glsl"
#include "svdag/candidate.glsl"

// Two chains, so that no common change of several children leaves both unchanged.
uvec2 addToHash(uvec2 chains, uint child_class)
{
    uint y = (chains.y ^ child_class) * 0x01000193u;
    return uvec2(hash(chains.x + child_class), y ^ (y >> 15));
}

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    Node node = params.nodes.data[params.first_node + index];
    uint count = childCount(node);
    uvec2 chains = uvec2(hashMask(node.mask_lo, node.mask_hi), hashMask(node.mask_hi, node.mask_lo));
    for (uint i = 0u; i < count; i += 4u)
    {
        uvec4 children = childrenAt(node, params.nodes, fourOf(count, i)) - params.child_reference;
        uvec4 classes = loadFour(params.classes, children);
        chains = addToHash(chains, classes.x);
        chains = i + 1u < count ? addToHash(chains, classes.y) : chains;
        chains = i + 2u < count ? addToHash(chains, classes.z) : chains;
        chains = i + 3u < count ? addToHash(chains, classes.w) : chains;
    }
    params.hashes.data[index] = chains & params.hash_mask;
}
