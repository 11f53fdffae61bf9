// SPDX-License-Identifier: MIT
// Children of candidates (svdag/svdag.h). The includer defines before:
//   LISTS_CONSTANT_ID    constant_id of kEntriesPerWord
#include "lib/lists.glsl"

layout(constant_id = LISTS_CONSTANT_ID) const uint kEntriesPerWord = 0u; // of candidates' lists; 0: there are none

uint childCount(Node node)
{
    return bitCount(node.mask_lo) + bitCount(node.mask_hi);
}

// The reference to the child with so many before it in the node: its number, or kChildList and the index of an entry.
uint childIndexAfter(Node node, uint before)
{
    uint low = bitCount(node.mask_lo);
    return before < low ? node.base_lo + before : node.base_hi + (before - low);
}

// The child of an inner node with so many before it in the node.
uint childAt(Node node, Node_ConstPtr nodes, uint before)
{
    uint index = childIndexAfter(node, before);
    if (kEntriesPerWord != 0u && (index & kChildList) != 0u)
        index = listEntry(uint64_t_ConstPtr(uint64_t(nodes)), index & ~kChildList, kEntriesPerWord);
    return index;
}
