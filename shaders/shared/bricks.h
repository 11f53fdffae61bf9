// SPDX-License-Identifier: MIT
// The brick table: an open-addressing hash table of octree nodes under construction.
#ifndef ZVO_SHADERS_SHARED_BRICKS_H
#define ZVO_SHADERS_SHARED_BRICKS_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

/// One node: key = Morton code of the node among the nodes of its level, with a leading one bit: the root is 1, and
/// key >> 6 is the parent's key. A depth of 12, six node levels, takes 31 bits. Deeper grids have wide keys:
/// kBrickKeyBits of them in the first word and the rest in the last, both with the bit kBrickKeyTag, so that neither
/// word is 0.
///
///     byte 0        4        8        12       16
///          | key    | mask_lo| mask_hi| base   |
///          | key_lo | mask_lo| mask_hi| key_hi |   wide
///
/// A first word of 0 means that the entry is free. Both words of a wide key are set by the end of the dispatch that
/// sets them. The masks are those of Node. base is the node's index, once it has one. With wide keys base is not
/// available: the index takes the place of mask_lo, as the masks are then in the node. While voxelization covers
/// bricks, mask_lo is a brick's number among them.
struct BrickEntry
{
    uint key;
    uint mask_lo; // or node index
    uint mask_hi;
    uint base; // or upper word of the key
};
GPU_BUFFER(BrickEntry, 16);

/// The mixed voxels of a leaf, those that several fragments share, where sums are kept of them alone.
///
///     byte 0        4        8        12       16
///          | mask_lo| mask_hi| first  | 0      |
struct MixedVoxels
{
    uint mask_lo;
    uint mask_hi;
    uint first; // of their sums; those of a leaf stand together, in the order of the mask
    uint zero;
};
GPU_BUFFER(MixedVoxels, 16);

const uint kBrickBytes = 16u; // of an entry, and of MixedVoxels

const uint kNarrowLevelsMax = 6u;   // node levels of octrees whose keys fit one word
const uint kBrickKeyBits = 30u;     // of a wide key in its first word: five levels of octants twice over
const uint kBrickKeyTag = 1u << 31; // in both words of a wide key

const uint kBrickProbesMax = 256u; // entries looked at before the table counts as full
const uint kBrickRunLog2 = 3u;     // neighbours in Morton order share a run of 1 << kBrickRunLog2 entries

/// A node under construction: the numbers of its own and its parent's entry in the brick table.
struct WorkItem
{
    uint entry;
    uint parent_entry;
};
GPU_BUFFER(WorkItem, 4);

/// Counts of what happened to the table.
struct BrickCounters
{
    uint node_count;     // nodes listed so far
    uint overflow_count; // inserts that found no slot
    uint full_nodes[10]; // nodes of a level without a triangle that are inside, from the lowest level up
    uint undecided[10];  // and those of which as many axes say that they are inside as that they are outside
    uint arrived[10];    // threads that have listed the nodes of a level, from the lowest up (lib/arrivals.glsl)
};
GPU_BUFFER(BrickCounters, 4);

GPU_NAMESPACE_END

#endif
