// SPDX-License-Identifier: MIT
// Voxels by bricks (shaders/voxelize/bricks.h): triangles are divided into items, each in one block of 16^3 cells; then
// a thread takes an item.
#pragma once

#include "core/base/grid.h"
#include "core/deform/dynamic_object.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/voxelize.h"
#include "vk/frame_graph.h"
#include "voxelize/bricks.h"
#include "zvo/types.h"

#include <cstdint>

namespace zvo
{

/// The capacities of the buffers of bricks.
struct BrickCapacities
{
    std::uint64_t entries = 0;  // of the table of bricks and of the nodes above them, a power of two
    std::uint64_t bricks = 0;   // that triangles may touch
    std::uint64_t items = 0;    // of all bricks
    std::uint64_t large = 0;    // blocks of large triangles
    std::uint64_t setups = 0;   // of triangles: gpu::kChunkTriangles a whole chunk, and one a single triangle
    std::uint64_t surfaces = 0; // as many, or 0 if no material has a texture and no vertex a colour

    /// A guess from the scene's surface area and the grid; it suffices in most cases.
    static BrickCapacities estimate(const GpuScene& scene, const Grid& grid);

    /// Of BrickBuffers::masks. mixed: BrickBuffers::has_mixed.
    [[nodiscard]] std::uint64_t maskWords(bool mixed) const;

    /// The bytes of BrickBuffers, but for `mixed`, and of octree construction with a table of these.
    [[nodiscard]] std::uint64_t bytes(bool mixed) const;

    /// Of the largest of these buffers.
    [[nodiscard]] std::uint64_t largestBytes(bool mixed) const;

    bool operator==(const BrickCapacities&) const = default;
};

/// The buffers by which triangles get into bricks, and what is known of the bricks.
struct BrickBuffers
{
    /// of_mixed: sums are kept of mixed voxels alone.
    BrickBuffers(vk::Device& device, const BrickCapacities& capacities, bool of_mixed);

    bool has_mixed;
    vk::BufferOf<gpu::TriangleSetup> setups;  // [setups]
    vk::BufferOf<gpu::SurfaceSetup> surfaces; // [surfaces]
    vk::BufferOf<gpu::BrickEntry> table;      // [entries] bricks; octree construction adds the nodes above them
    vk::BufferOf<gpu::BrickRange> ranges;     // [bricks] in any order
    vk::BufferOf<gpu::BrickItem> items;       // [items] in the order of triangles, mostly
    vk::BufferOf<gpu::ItemVoxels> voxels;     // [items]
    vk::BufferOf<gpu::LargeBlock> large;      // [large]
    vk::BufferOf<gpu::uint> masks;            // [maskWords()] of each brick's leaves, then of their mixed voxels
    vk::BufferOf<gpu::BinCounters> counters;  // [1]
    vk::BufferOf<gpu::BrickCounters> nodes;   // [1] those of octree construction
    vk::BufferOf<gpu::uint> work_bricks;      // [bricks] of each work item of octree construction, the number in ranges
    vk::BufferOf<gpu::uint> order;            // [bricks] numbers in ranges, in the order of nodes
    vk::BufferOf<gpu::uint> partials;         // [ceil(bricks / gpu::kScanBlock)]
    vk::BufferOf<gpu::uint> total;            // [1]
    vk::BufferOf<gpu::MixedVoxels> mixed;     // [leaves] with has_mixed, allocated when their number is known
};

/// What is voxelized, and into which buffers.
struct BrickJob
{
    PosedGpuScene scene;
    GridTile tile;
    BrickBuffers& buffers;
};

/// Whether voxelization by bricks can take a scene: by thin coverage, if nothing emits light.
bool suitsBricks(const GpuScene& scene, const Grid& grid, Coverage coverage);

/// Records the passes that put the triangles into bricks, and set the bit of every covered voxel in the masks of these.
/// What does not fit is counted, never written. Cost: triangles, items, and the capacity of the table once.
void coverBricks(vk::FrameGraph& graph, const BrickJob& job);

/// Makes the kernels of placeLeaves(), so that recording it cannot fail.
void prepareLeaves(vk::Device& device, const Grid& grid, const BrickBuffers& buffers);

/// Records the passes that number the voxels of bricks, and write the nodes of leaves. The nodes above must have their
/// numbers (numberNodes), and buffers.mixed its size. work: [bricks first] work items of octree construction. Cost:
/// bricks and the cells of their leaves.
void placeLeaves(vk::FrameGraph& graph, const Grid& grid, BrickBuffers& buffers,
                 const vk::BufferOf<gpu::WorkItem>& work, DeviceTree& octree);

/// Records the passes that write the attributes of the voxels. item_count: as counted. int64: two words of sums by
/// one atomic. attributes.sums: [BinCounters::mixed_count] with has_mixed, else [voxels]. Cost: items, fragments and
/// leaves.
void shadeBricks(vk::FrameGraph& graph, const BrickJob& job, std::uint32_t item_count, bool int64,
                 AttributeBuffers& attributes, DeviceTree& octree);

} // namespace zvo
