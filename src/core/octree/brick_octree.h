// SPDX-License-Identifier: MIT
// From bricks, whose masks some operation has set, to a finished octree: what all builders of octrees have in common.
#pragma once

#include "core/octree/octree_build.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/voxelize.h"
#include "vk/readback.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// Bricks with the list of the nodes from them up.
struct OctreeBricks
{
    VoxelizeBuffers voxelize;
    OctreeBuildBuffers work;
    LeafBuffers leaves; // allocated when their number is known
};

/// What listNodes() has counted.
struct BrickCounts
{
    gpu::BinCounters bins;
    gpu::BrickCounters nodes;
    std::vector<gpu::LevelRange> listed; // nodes of each level above the leaves, from the lowest up
};

/// Where the counts stand in a readback.
struct BrickCountOffsets
{
    std::uint64_t bins = 0;
    std::uint64_t nodes = 0;
    std::uint64_t ranges = 0; // of work items, by level
};

/// Bytes of a readback that has room for them.
inline constexpr std::uint64_t kBrickReadbackBytes = 1024;

/// Records the copies of the counts of bricks, whose octree has level_count levels.
BrickCountOffsets copyCounts(vk::FrameGraph& graph, vk::Readback& readback, const OctreeBricks& bricks,
                             std::uint32_t level_count);

/// What was copied.
BrickCounts readCounts(const vk::Readback& readback, const BrickCountOffsets& offsets, std::uint32_t level_count);

/// Sets the levels and numbers of an octree, and allocates its nodes: those of the node list, which ends with the root,
/// full nodes, and the leaves of the bricks. Without voxels, node_count becomes 0. Throws Error{Memory} for more than
/// 32-bit numbers count, or the device's budget.
void allocateNodes(vk::Device& device, const BrickCounts& counts, OctreeBricks& bricks, DeviceTree& octree);

/// Records numberNodes() after allocating what it writes.
void numberBricks(vk::FrameGraph& graph, OctreeBricks& bricks, DeviceTree& octree);

/// Records the passes that give an octree with voxel attributes those of its nodes.
void averageOctree(vk::FrameGraph& graph, const GpuScene& color_tables, bool filled, DeviceTree& octree);

/// Records the pass that makes leaf words of an octree's leaves, which are nodes until then, in a pool that takes the
/// place of its nodes once the device is done: see takePool(). An octree of one level keeps its nodes.
/// occupied: the masks of the leaves of a filled octree.
void addLeafWords(vk::FrameGraph& graph, const vk::BufferOf<gpu::uvec2>& occupied, DeviceTree& octree,
                  vk::BufferOf<gpu::Node>& pool);
void takePool(vk::BufferOf<gpu::Node> pool, bool filled, DeviceTree& octree);

} // namespace zvo
