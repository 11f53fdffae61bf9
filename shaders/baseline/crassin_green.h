// SPDX-License-Identifier: MIT
// What the kernels of Crassin and Green share with the host: C. Crassin, S. Green, Octree-Based Sparse Voxelization
// Using the GPU Hardware Rasterizer, OpenGL Insights, 2012. Node 0 is the root; the tiles of a level stand together.
#ifndef ZVO_SHADERS_BASELINE_CRASSIN_GREEN_H
#define ZVO_SHADERS_BASELINE_CRASSIN_GREEN_H

#include "baseline/pointer_octree.h"
#include "octree/octree.h"
#include "shared/scene.h"
#include "voxelize/voxelize.h"

GPU_NAMESPACE_BEGIN

const uint kCrassinGreenGroup = 64u;    // threads of a workgroup where one thread takes a fragment or a node
const uint kCrassinGreenLevels = 14u;   // levels of nodes at kPointerDepthMax
const uint kPointerFlagged = 1u << 31u; // PointerNode::child of an inner node that is to get a tile

struct CrassinGreenParams // push constants of all kernels of this file
{
    GPU_CONST_PTR(VoxelFragment) fragments; // [fragment_count]
    GPU_PTR(PointerNode) nodes;             // [node_capacity]
    GPU_PTR(LevelRange) ranges;             // [kCrassinGreenLevels] the nodes of each level, the root first
    GPU_PTR(DispatchArgs) args;             // [kCrassinGreenLevels] for one thread a node
    GPU_PTR(uint) tile_count;               // [1] tiles asked for, with room or not
    GPU_PTR(VoxelSums) sums;                // [sum_capacity] of the nodes of the lowest level
    GPU_CONST_PTR(SceneView) scene;         // for its tables of colours
    uint fragment_count;
    uint node_capacity;
    uint sum_capacity;
    uint level; // that is taken; of baseline/crassin_green_next, the one above it
    uint depth;
};
GPU_KERNEL(baseline, crassin_green_flag, CrassinGreenFlag, CrassinGreenParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, crassin_green_allocate, CrassinGreenAllocate, CrassinGreenParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, crassin_green_next, CrassinGreenNext, CrassinGreenParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, crassin_green_clear, CrassinGreenClear, CrassinGreenParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, crassin_green_add, CrassinGreenAdd, CrassinGreenParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, crassin_green_resolve, CrassinGreenResolve, CrassinGreenParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, crassin_green_mipmap, CrassinGreenMipmap, CrassinGreenParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
