// SPDX-License-Identifier: MIT
// The sparse voxel DAG in device memory: an octree whose equal subtrees are stored once (V. Kaempe, E. Sintorn,
// U. Assarsson, High Resolution Sparse Voxel DAGs, 2013), with the nodes of shared/octree.h.
//
// Nodes and lists share one buffer, the pool:
//
//     inner nodes, level by level from the root on | leaf words | lists, those of the root first | zeros up to a node
//
// Lists are entries, numbers of nodes or of leaf words, of which a word of 64 bits holds as many as the largest number
// allows: 4 of 16 bits, 3 of 21 or 2 of 32, the first one in the lowest bits. Entries have *indices*, counted from the
// pool's first word on as if all of it were entries: index i is in word i / entries per word, and lists start with a
// word.
//
// A half of a node with kChildList in its base has a list: child c of it is the entry with the index
// (base & ~kListFlags) + popcount(mask & bits below c), which names a leaf word if the base has kLeafWords. Without a
// list its children stand together, as an octree's do. Inner nodes of a DAG have one list for both halves:
// base_hi = base_lo + popcount(mask_lo). A leaf that is a node has base_lo 0 and base_hi popcount(mask_lo): what would
// be a child is the voxel's number in the leaf.
//
// In a *filled* DAG (shared/octree.h) each leaf takes a whole node: its word, which has an even number, and its surface
// mask. One *full node* follows them, whose list names it 64 times, at any level; this list comes before all others.
// Nodes above leaves that are occupied throughout have that list, too:
//
//     inner nodes | leaves: word, surface mask | full node | list of the full node | other lists, that of the root
//     first
//
// Nodes of a level stand in the order in which they first occur in the octree; lists in the order of their nodes.
//
// Voxels, and their attributes, have the octree's numbers, in Morton order: the sum, over the path to a voxel, of the
// voxels before each child in its node, and the voxel's number in its leaf (D. Dolonius, E. Sintorn, V. Kaempe,
// U. Assarsson, Compressing Color Data for Voxelized Surface Geometry, 2017). Counts for that stand in arrays of their
// own, by entries: long ones, those of nodes above the parents of leaves, come first. Those of the full node count as
// long, and each has kInteriorIndex as its number of nodes.
#ifndef ZVO_SHADERS_SHARED_SVDAG_H
#define ZVO_SHADERS_SHARED_SVDAG_H

#include "shared/octree.h"

GPU_NAMESPACE_BEGIN

const uint kChildList = 0x80000000u; // flag in Node::base_lo and base_hi
const uint kListFlags = kChildList | kLeafWords;
const uint kListWordBits = 64u; // of a word of entries
const uint kFilledDag = 8u;     // flag beside the entries of a word, as kernels take them: the DAG is filled
const uint kFullEntries = 64u;  // of a filled DAG, the first ones of all

/// Of a long entry: how many voxels and nodes the octree has below the node's children before this one. For the entries
/// of parents of leaves there are only 16 bits each, two to a word, the lower half first: voxels before the leaf.
struct BeforeChild
{
    uint voxels;
    uint nodes;
};
GPU_BUFFER(BeforeChild, 8);

/// The arrays from which the ranks of voxels, and of the octree's nodes depth first, are summed up.
struct RankSource
{
    GPU_CONST_PTR(Node) pool;
    GPU_CONST_PTR(BeforeChild) before;      // by indices of entries: those of the long ones; of an octree, leaf groups
    GPU_CONST_PTR(uint) voxels_before_leaf; // two entries a word
    uint first_short_entry;                 // of the first entry that is not long
};

GPU_NAMESPACE_END

#endif
