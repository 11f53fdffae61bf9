// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/voxelize.h"
#include "octree/octree.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// The buffers that octree construction needs beside those of voxelization.
struct OctreeBuildBuffers
{
    /// table_capacity, brick_capacity: of VoxelizeCapacities.
    OctreeBuildBuffers(vk::Device& device, std::uint64_t table_capacity, std::uint64_t brick_capacity);

    /// The bytes of such buffers.
    static std::uint64_t bytes(std::uint64_t table_capacity, std::uint64_t brick_capacity);

    vk::BufferOf<gpu::WorkItem> items;         // [table_capacity] the bricks first, the root last
    vk::BufferOf<gpu::BrickCounters> counters; // [1]
    vk::BufferOf<gpu::LevelRange> ranges;      // [kNodeLevelsMax] the items of each level, bricks first
    vk::BufferOf<gpu::DispatchArgs> args;      // [kNodeLevelsMax] of each level, bricks first: one thread an item
    vk::BufferOf<gpu::uint> partials;          // for each level, the children of kScanBlock nodes each
    vk::BufferOf<gpu::uint> total;             // [1]
    vk::BufferOf<gpu::uint> bricks;            // [brick_capacity] of each brick's item, the number in ranges of bricks
    vk::BufferOf<gpu::uint> order;             // [brick_capacity] these numbers in the order of nodes; where voxels are
                                               // filled, [nodes of bricks], allocated when their number is known
    vk::BufferOf<gpu::uint> brick_partials;    // the voxels of kScanBlock bricks each
    std::vector<std::uint32_t> item_counts;    // of each level above the leaves, the root first: full nodes have none
};

/// Buffers of the leaves that are being made, [leaves] each or empty.
struct LeafBuffers
{
    vk::BufferOf<gpu::MixedVoxels> mixed; // with VoxelForm::mixed
    vk::BufferOf<gpu::uvec2> occupied;    // with VoxelForm::fill: the masks of surface and inside
};

/// Records the passes that list the bricks that have voxels and add all their ancestors to list and table, level by
/// level (Baert, Lagae and Dutre, Out-of-Core Construction of Sparse Voxel Octrees, 2013, without the sort). Afterwards
/// work.ranges, work.counters and voxelize.counters hold the numbers of nodes and voxels. Cost: nodes, and the cells of
/// the bricks' leaves.
void listNodes(vk::FrameGraph& graph, const GridTile& tile, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work);

/// Records the passes that find the nodes above bricks that are inside and that no triangle may touch, where voxels are
/// filled. To be recorded after listNodes(). Cost: nodes.
void listFullNodes(vk::FrameGraph& graph, const GridTile& tile, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work);

/// Records the passes that number the nodes breadth first, in Morton order within a level, and write octree.nodes from
/// the root down, and leaves. octree.levels, node_count and nodes and work.item_counts must be set up. Full nodes get
/// empty masks, and leaves the masks of the surface. The numbers come from prefix sums, so they do not depend on the
/// order of threads. Cost: nodes, and the cells of the bricks' leaves.
void numberNodes(vk::FrameGraph& graph, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work, LeafBuffers& leaves,
                 DeviceTree& octree);

/// Records the passes that give each inner node the mean attribute of its children, from the leaves up: a pass for each
/// level, and one for the root's children and the root. Cost: nodes.
void averageNodes(vk::FrameGraph& graph, const GpuScene& scene, DeviceTree& octree);

/// Records the passes that give nodes of a filled octree without a surface the colour of the node above, from the root
/// down. To be recorded after averageNodes(). Cost: nodes.
void inheritColors(vk::FrameGraph& graph, DeviceTree& octree);

/// Records the pass that copies the nodes of an octree of several levels, whose leaves are nodes, to a pool with leaf
/// words and its leaf groups (shaders/shared/octree.h).
/// occupied: as in LeafBuffers.
void makeLeafWords(vk::FrameGraph& graph, const DeviceTree& octree, const vk::BufferOf<gpu::uvec2>& occupied,
                   vk::BufferOf<gpu::Node>& pool, vk::BufferOf<gpu::uvec2>& leaf_groups);

} // namespace zvo
