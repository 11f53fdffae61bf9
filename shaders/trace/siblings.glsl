// SPDX-License-Identifier: MIT
// Writes nodes of the beam grid that have the same parent, a thread of a workgroup of kBeamGroup each.

shared uint s_siblings[2]; // mask of the parent

// Writes those whose mask is not 0, and returns the parent's mask. first: where there is room for them. Call in uniform
// control flow, once a workgroup.
uvec2 writeSiblings(Node_Ptr nodes, uint first, uvec2 mask, uint first_child)
{
    uint half_number = gl_LocalInvocationIndex >> 5;
    uint bit = 1u << (gl_LocalInvocationIndex & 31u);
    bool exists = (mask.x | mask.y) != 0u;
    if (gl_LocalInvocationIndex < 2u)
        s_siblings[gl_LocalInvocationIndex] = 0u;
    barrier();
    if (exists)
        atomicOr(s_siblings[half_number], bit);
    barrier();
    uint slot = first + 32u * half_number + bitCount(s_siblings[half_number] & (bit - 1u));
    if (exists)
        nodes.data[slot] = Node(mask.x, first_child, mask.y, first_child + 32u);
    return uvec2(s_siblings[0], s_siblings[1]);
}
