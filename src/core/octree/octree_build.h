// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/bricks.h"
#include "core/voxelize/voxelize.h"
#include "octree/octree.h"
#include "vk/frame_graph.h"

#include <cstddef>
#include <cstdint>

namespace zvo
{

/// The buffers that octree construction needs beside the brick table.
struct OctreeBuildBuffers
{
    OctreeBuildBuffers(vk::Device& device, std::uint64_t brick_capacity);

    vk::BufferOf<gpu::WorkItem> items;    // [brick_capacity] the leaves first, the root last
    vk::BufferOf<gpu::LevelRange> ranges; // [kNodeLevelsMax] the items of each level, leaves first
    vk::BufferOf<gpu::DispatchArgs> args; // [kNodeLevelsMax] of each level, leaves first: one thread an item
    vk::BufferOf<gpu::uint> partials;     // for each level, the children of kScanBlock nodes each
    vk::BufferOf<gpu::uint> total;        // [1]
};

/// Records the passes that list the leaves of the brick table and add all their ancestors to list and table, level by
/// level (Baert, Lagae and Dutre, Out-of-Core Construction of Sparse Voxel Octrees, 2013, without the sort). Afterwards
/// work.ranges and voxelize.counters hold the numbers of nodes and voxels. Cost: nodes, and one read of every entry of
/// the table.
void listNodes(vk::FrameGraph& graph, const Grid& grid, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work);

/// Records the passes that do the same for bricks, which have taken the place of leaves.
void listBricks(vk::FrameGraph& graph, const Grid& grid, BrickBuffers& bricks, OctreeBuildBuffers& work);

/// Records the passes that number the nodes breadth first, in Morton order within a level, and write octree.nodes from
/// the root down. octree.levels, node_count and nodes must be set up. The entries of leaves in the brick table receive
/// the number of their first voxel. The numbers come from prefix sums, so they do not depend on the order of threads.
/// level_count: levels from the root on that are numbered, all of them or all but the leaves. Cost: nodes.
void numberNodes(vk::FrameGraph& graph, vk::BufferOf<gpu::BrickEntry>& table, OctreeBuildBuffers& work,
                 DeviceTree& octree, std::size_t level_count);

/// Records the passes that give each inner node the mean attribute of its children, from the leaves up: a pass for each
/// level, and one for the root's children and the root. Cost: nodes.
void averageNodes(vk::FrameGraph& graph, const GpuScene& scene, DeviceTree& octree);

/// Records the pass that copies the nodes of an octree of several levels, whose leaves are nodes, to a pool with leaf
/// words and its leaf groups (shaders/shared/octree.h).
void makeLeafWords(vk::FrameGraph& graph, const DeviceTree& octree, vk::BufferOf<gpu::Node>& pool,
                   vk::BufferOf<gpu::uvec2>& leaf_groups);

} // namespace zvo
