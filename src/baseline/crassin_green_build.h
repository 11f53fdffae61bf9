// SPDX-License-Identifier: MIT
// C. Crassin, S. Green, Octree-Based Sparse Voxelization Using the GPU Hardware Rasterizer, OpenGL Insights, 2012.
#pragma once

#include "baseline/crassin_green.h"
#include "baseline/pointer_tree.h"
#include "core/upload/gpu_scene.h"
#include "vk/frame_graph.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo::baseline
{

/// The buffers that the construction needs beside fragments and nodes.
struct CrassinGreenBuffers
{
    explicit CrassinGreenBuffers(vk::Device& device);

    vk::BufferOf<gpu::LevelRange> ranges; // [kCrassinGreenLevels] the nodes of each level, the root first
    vk::BufferOf<gpu::DispatchArgs> args; // [kCrassinGreenLevels] for one thread a node
    vk::BufferOf<gpu::uint> tile_count;   // [1] tiles asked for
    vk::BufferOf<gpu::VoxelSums> sums;    // [nodes of the lowest level] allocated once their number is known
};

/// What the octree is made of. Fragments may come in any order, several of a voxel among them: from listFragments(),
/// for one. The paper's come from the rasterizer, with the colour alone.
struct CrassinGreenJob
{
    const GpuScene& scene; // for its tables of colours
    const vk::BufferOf<gpu::VoxelFragment>& fragments;
    CrassinGreenBuffers& buffers;
    PointerOctree& octree;
};

/// Records the passes that make the nodes from the root down, four a level: a thread a fragment flags the node that it
/// is in, flagged nodes get tiles by an atomic counter, the next level is sized and emptied
/// (baseline/crassin_green_flag, _allocate, _next and _clear). Node 0 becomes the root; the numbers of other nodes
/// depend on the order of threads. What has no room in octree.nodes is only counted, in buffers.tile_count. Cost:
/// fragments times depth squared, and nodes.
void makeNodes(vk::FrameGraph& graph, const CrassinGreenJob& job);

/// Records the passes that average: fragments are added to sums and become voxels (_add, _resolve), and each level from
/// the voxels up gets the means of its children (_mipmap). To be recorded after makeNodes(). The mean of a voxel is
/// zvo's but for the rounding of each fragment to 8-bit colours; the paper keeps a running mean in 8 bits. Up to 65,535
/// fragments a voxel count. Cost: fragments times depth, and nodes.
void averageNodes(vk::FrameGraph& graph, const CrassinGreenJob& job);

/// An octree, and how it came about.
struct CrassinGreenBuild
{
    PointerOctree octree;
    std::vector<vk::PassTime> passes; // of the runs that succeeded
};

/// Makes the octree, and waits after each of its runs: with nodes for a guess, again with more while they do not
/// suffice, then averages. Throws Error{Usage} for a depth beyond gpu::kPointerDepthMax, Error{Memory}.
CrassinGreenBuild buildTopDown(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid,
                               const vk::BufferOf<gpu::VoxelFragment>& fragments, CrassinGreenBuffers& buffers);

} // namespace zvo::baseline
