// SPDX-License-Identifier: MIT
// Nodes and their children (shared/octree.h), which lists may name (shared/svdag.h), by their references.
#ifndef ZVO_SHADERS_LIB_NODE_GLSL
#define ZVO_SHADERS_LIB_NODE_GLSL

#include "shared/svdag.h"

// Whether a tree is a filled DAG. per_word: of entries, as kernels take it.
bool isFilledDag(uint per_word)
{
    return (per_word & kFilledDag) != 0u;
}

// The entry with an index. per_word: of all entries of the pool, 2, 3 or 4, best a constant; kFilledDag may be set.
uint listEntry(uint64_t_ConstPtr pool, uint index, uint per_word)
{
    per_word &= ~kFilledDag;
    if (per_word != 3u)
    {
        // Reads half words, because shifts of 64 bits are slow.
        uint half_word = uint_ConstPtr(uint64_t(pool)).data[per_word == 4u ? index >> 1 : index];
        return per_word == 4u ? bitfieldExtract(half_word, int(16u * (index & 1u)), 16) : half_word;
    }
    uint bits = kListWordBits / per_word;
    return uint(pool.data[index / per_word] >> (bits * (index % per_word))) & ((1u << bits) - 1u);
}

// Four entries, whose words are loaded together.
uvec4 listEntries(uint64_t_ConstPtr pool, uvec4 indices, uint per_word)
{
    return uvec4(listEntry(pool, indices.x, per_word), listEntry(pool, indices.y, per_word),
                 listEntry(pool, indices.z, per_word), listEntry(pool, indices.w, per_word));
}

bool isLeafWord(uint reference)
{
    return (reference & kLeafWords) != 0u;
}

// The number of a word, of a reference to a leaf word.
uint leafWord(uint reference)
{
    return reference & ~kLeafWords;
}

// Voxels before a pair of words, by the leaf group that they are in. pair: half the number of the words.
uint voxelsBeforePair(uvec2 group, uint pair)
{
    uint low = bitfieldExtract(group.y, 0, int(kGroupShift2));
    uint middle = bitfieldExtract(group.y, int(kGroupShift2), int(kGroupShift3 - kGroupShift2));
    uint upper = (pair & 1u) != 0u ? group.y >> kGroupShift3 : middle;
    return group.x + ((pair & 2u) != 0u ? upper : (pair & 1u) != 0u ? low : 0u);
}

// The masks of a node.
uvec2 nodeMask(Node_ConstPtr pool, uint reference)
{
    if (isLeafWord(reference))
        return unpackUint2x32(uint64_t_ConstPtr(uint64_t(pool)).data[leafWord(reference)]);
    uint number = reference & ~kFullNodes;
    return uvec2(pool.data[number].mask_lo, pool.data[number].mask_hi);
}

// The first voxel of a leaf word of an octree.
uint firstVoxel(Node_ConstPtr pool, uvec2_ConstPtr leaf_groups, uint reference)
{
    uint word = leafWord(reference);
    uint voxels = voxelsBeforePair(leaf_groups.data[kFirstLeafGroup + word / kLeafGroup], word >> 1);
    uint pair = (word >> 1) + leaf_groups.data[1].x;
    uvec2 mask = unpackUint2x32(uint64_t_ConstPtr(uint64_t(pool)).data[2u * pair]); // of the pair's first leaf
    return voxels + ((word & 1u) != 0u ? bitCount(mask.x) + bitCount(mask.y) : 0u);
}

// A node by its reference. For a leaf word, the leaf that it stands for, as a node: of a filled tree, with the voxels
// that have attributes. leaf_groups: of an octree, or null: bases of a leaf count from 0 then, as in a DAG.
Node loadNodeOf(Node_ConstPtr pool, uvec2_ConstPtr leaf_groups, uint reference)
{
    if (!isLeafWord(reference))
        return pool.data[reference & ~kFullNodes];
    uint surface = reference;
    uint first = 0u;
    if (uint64_t(leaf_groups) != 0ul)
    {
        first = firstVoxel(pool, leaf_groups, reference);
        surface += 2u * leaf_groups.data[1].x;
    }
    uvec2 mask = nodeMask(pool, surface);
    return Node(mask.x, first, mask.y, first + bitCount(mask.x));
}

bool isFullNode(uint reference)
{
    return (reference & kFullNodes) != 0u;
}

// A node that is no leaf word, by its reference.
Node loadInner(Node_ConstPtr pool, uint reference)
{
    return pool.data[reference & ~kFullNodes];
}

// What is inside, and has no attributes, looks like the node around it.
Attribute interiorLook(Attribute around)
{
    return Attribute(around.color & kColorMask, kNoNormal);
}

// A node by its reference as an overlay has a copy of it.
Node loadCopyOf(Node_ConstPtr pool, uvec2_ConstPtr leaf_groups, uint reference)
{
    bool is_filled = isLeafWord(reference) && uint64_t(leaf_groups) != 0ul;
    if (is_filled)
        is_filled = leaf_groups.data[1].x != 0u;
    if (!is_filled)
        return loadNodeOf(pool, leaf_groups, reference);
    uvec2 mask = nodeMask(pool, reference);
    return Node(mask.x, kFullNodes | reference, mask.y, kFullNodes | reference);
}

// A leaf by its reference, static or of an overlay, with those of its voxels that have attributes.
Node loadSurfaceOf(Node_ConstPtr pool, uvec2_ConstPtr leaf_groups, uint reference)
{
    Node leaf = loadNodeOf(pool, leaf_groups, reference);
    if (uint64_t(leaf_groups) != 0ul && !isLeafWord(reference) && isFullNode(leaf.base_lo))
    {
        uint word = leaf.base_lo & ~kFullNodes;
        leaf = Node(0u, 0u, 0u, 0u);
        if (isLeafWord(word))
            leaf = loadNodeOf(pool, leaf_groups, word);
    }
    return leaf;
}

// The index of a node's attributes in an octree with leaf words. first: element 0 of the leaf groups.
uint nodeIndexBy(uvec2 first, uint reference)
{
    uint behind = reference >= first.x ? reference + first.y : reference;
    return isLeafWord(reference) ? leafWord(reference) - first.x : behind;
}

// The index of a node's attributes in an octree. leaf_groups: null if leaves are nodes, which have their numbers.
uint nodeIndexOf(uvec2_ConstPtr leaf_groups, uint reference)
{
    uint index = reference;
    if (uint64_t(leaf_groups) != 0ul)
        index = nodeIndexBy(leaf_groups.data[0], reference);
    return index;
}

// Whether a node is the static root of a tree with room for overlays, or stands behind it.
bool isBehind(uint static_root, uint reference)
{
    return (reference & (kLeafWords | kFullNodes)) == 0u && reference >= static_root;
}

// Whether the bit of a cell is set in masks as a node has them.
bool hasCell(uvec2 mask, uint cell)
{
    return (((cell < 32u ? mask.x : mask.y) >> (cell & 31u)) & 1u) != 0u;
}

bool hasChild(Node node, uint cell)
{
    return hasCell(uvec2(node.mask_lo, node.mask_hi), cell);
}

// The reference of the child in a cell or, in a leaf, the index of the voxel's attribute; for a missing one, what it
// would be. For a list, kChildList, kLeafWords if it names leaf words, and the index of the entry that names the child.
uint childIndex(Node node, uint cell)
{
    uint below = (1u << (cell & 31u)) - 1u;
    return cell < 32u ? node.base_lo + bitCount(node.mask_lo & below) : node.base_hi + bitCount(node.mask_hi & below);
}

// The reference of the child that childIndex() found, which must exist, of a node in a pool that may have lists.
uint listedChild(Node_ConstPtr pool, uint index, uint per_word)
{
    uint child = index;
    if (per_word != 0u && (index & kChildList) != 0u)
        child = listEntry(uint64_t_ConstPtr(uint64_t(pool)), index & ~kListFlags, per_word) | (index & kLeafWords);
    return child;
}

#endif
