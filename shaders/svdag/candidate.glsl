// SPDX-License-Identifier: MIT
// Children of candidates (svdag/svdag.h). The includer defines before:
//   LISTS_CONSTANT_ID    constant_id of kEntriesPerWord
#include "lib/lists.glsl"

layout(constant_id = LISTS_CONSTANT_ID) const uint kEntriesPerWord = 0u; // of candidates' lists; 0: there are none

uint childCount(Node node)
{
    return bitCount(node.mask_lo) + bitCount(node.mask_hi);
}

// Where the child with so many before it in the node is named: its number, or the place of an entry.
uint childPlace(Node node, uint before)
{
    uint low = bitCount(node.mask_lo);
    return before < low ? node.base_lo + before : node.base_hi + (before - low);
}

// The child of an inner node with so many before it in the node.
uint childAt(Node node, Node_ConstPtr nodes, uint before)
{
    uint place = childPlace(node, before);
    if (kEntriesPerWord != 0u && (place & kChildList) != 0u)
        place = listEntry(uint64_t_ConstPtr(uint64_t(nodes)), place & ~kChildList, kEntriesPerWord);
    return place;
}
