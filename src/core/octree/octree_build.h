// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/voxelize.h"
#include "octree/octree.h"
#include "vk/frame_graph.h"

#include <cstdint>

namespace zvo
{

/// What octree construction needs beside the brick table.
struct OctreeBuildBuffers
{
    OctreeBuildBuffers(vk::Device& device, std::uint64_t brick_capacity);

    vk::BufferOf<gpu::WorkItem> items;    // [brick_capacity] leaves first, the root last
    vk::BufferOf<gpu::LevelRange> ranges; // [kNodeLevelsMax] the items of each level, leaves first
    vk::BufferOf<gpu::DispatchArgs> args; // [kNodeLevelsMax] of each level, leaves first: one thread an item
    vk::BufferOf<gpu::uint> partials;     // [ceil(brick_capacity / kScanBlock)]
    vk::BufferOf<gpu::uint> total;        // [1]
};

/// Records the passes that list the leaves in the brick table and put all their ancestors beside them, level by level
/// (Baert, Lagae and Dutre, Out-of-Core Construction of Sparse Voxel Octrees, 2013, without the sort). Afterwards,
/// work.ranges and voxelize.counters tell how many nodes and voxels there are. Cost: nodes, and one look at every entry
/// of the table.
void listNodes(vk::FrameGraph& graph, const Grid& grid, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work);

/// Records the passes that put all ancestors of the leaves in items beside them, level by level: what is left of
/// listNodes when somebody else has listed the leaves. counters tells how many those are.
void listAncestors(vk::FrameGraph& graph, const Grid& grid, vk::BufferOf<gpu::BrickEntry>& bricks,
                   vk::BufferOf<gpu::BrickCounters>& counters, OctreeBuildBuffers& work);

/// Records the passes that number the nodes breadth first in Morton order and write octree.nodes, from the root down.
/// octree.levels, node_count and nodes must be set up. Leaves in the brick table learn their first voxel.
/// Cost: nodes. The numbers come from prefix sums: they do not depend on the order of threads.
void numberNodes(vk::FrameGraph& graph, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work, DeviceTree& octree);

/// Records the passes that give inner nodes the mean attribute of their children, from the leaves up. Cost: nodes.
void averageNodes(vk::FrameGraph& graph, const GpuScene& scene, DeviceTree& octree);

} // namespace zvo
