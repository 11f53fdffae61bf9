// SPDX-License-Identifier: MIT
// The child base of a node. The includer has a kernel's parameters as params.
#ifndef ZVO_SHADERS_OCTREE_ASSIGN_GLSL
#define ZVO_SHADERS_OCTREE_ASSIGN_GLSL

// tell_bricks: the node's entry in the brick table gets the base, too.
void setBase(uint node, uint mask_lo, uint base, bool tell_bricks)
{
    if (tell_bricks)
        params.bricks.data[params.nodes.data[node].base_hi].base = base;
    params.nodes.data[node].base_lo = base;
    params.nodes.data[node].base_hi = base + bitCount(mask_lo);
}

#endif
