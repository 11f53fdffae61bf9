// SPDX-License-Identifier: MIT
// Children of candidates (svdag/svdag.h). The includer defines before:
//   LISTS_CONSTANT_ID    constant_id of kLists

layout(constant_id = LISTS_CONSTANT_ID) const bool kLists = false; // some candidates have lists of children

uint childCount(Node node)
{
    return bitCount(node.mask_lo) + bitCount(node.mask_hi);
}

// Where the child with so many before it in the node is named: its number, or the word of a list.
uint childPlace(Node node, uint before)
{
    uint low = bitCount(node.mask_lo);
    return before < low ? node.base_lo + before : node.base_hi + (before - low);
}

// The child of an inner node with so many before it in the node.
uint childAt(Node node, uint_ConstPtr words, uint before)
{
    uint place = childPlace(node, before);
    if (kLists && (place & kChildList) != 0u)
        place = words.data[place & ~kChildList];
    return place;
}
