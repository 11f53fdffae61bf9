// SPDX-License-Identifier: MIT
// The octree that the thesis builds and that Crassin and Green build: nodes of 2x2x2 cells by pointers, in tiles of
// eight.
//
//     byte 0        4        8        12
//          | child  | color  | normal |
//
// The eight children of a node stand together, in Morton order, whether they are occupied or not: a tile. A node
// without voxels has a child of 0, whatever its level. The thesis gives a node 12 bytes, too; what it keeps in them
// beside the pointer is not printed, so here it is what zvo keeps of a node: colour and normal.
#ifndef ZVO_SHADERS_BASELINE_POINTER_OCTREE_H
#define ZVO_SHADERS_BASELINE_POINTER_OCTREE_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

/// A node, or a voxel at the lowest level.
struct PointerNode
{
    uint child;  // first node of its tile; kPointerVoxel for a voxel that is occupied; 0: nothing is here
    uint color;  // sRGB red | green << 8 | blue << 16, alpha 255 if something is here
    uint normal; // octahedral, snorm16 x | snorm16 y << 16
};
GPU_BUFFER(PointerNode, 4);

/// A triangle's share of a voxel.
struct VoxelFragment
{
    uint xy; // coordinates x | y << 16
    uint z;
    uint color;  // as in PointerNode
    uint normal; // as in PointerNode
};
GPU_BUFFER(VoxelFragment, 16);

const uint kTileNodes = 8u;            // nodes of a tile
const uint kPointerVoxel = 1u << 31;   // PointerNode::child of an occupied voxel
const uint kPointerDepthMax = 13u;     // of an octree that is traced: entries of a ray's stack
const uint kOpaqueColor = 255u << 24u; // alpha of PointerNode::color

GPU_NAMESPACE_END

#endif
