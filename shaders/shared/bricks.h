// SPDX-License-Identifier: MIT
// The brick table: an open-addressing hash table of octree nodes under construction, leaves and inner nodes alike.
#ifndef ZVO_SHADERS_SHARED_BRICKS_H
#define ZVO_SHADERS_SHARED_BRICKS_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

/// One node: key = Morton code of the node among the nodes of its level, with a leading one bit: the root is 1, and
/// key >> 6 is the parent's key. 0: the entry is free. So a depth of 12, six node levels, takes 31 bits.
struct BrickEntry
{
    uint key;
    uint mask_lo; // as in Node
    uint mask_hi;
    uint base; // node index while the octree is built; of a leaf, afterwards: its first voxel
};
GPU_BUFFER(BrickEntry, 16);

const uint kBrickProbesMax = 256u; // entries looked at before the table counts as full
const uint kBrickRunLog2 = 3u;     // neighbours in Morton order share a run of 1 << kBrickRunLog2 entries

/// What happened to the table.
struct BrickCounters
{
    uint node_count;     // nodes listed so far
    uint voxel_count;    // voxels in the leaves, modulo 2^32
    uint voxel_carry;    // how often that wrapped around
    uint overflow_count; // inserts that found no place
};
GPU_BUFFER(BrickCounters, 4);

GPU_NAMESPACE_END

#endif
