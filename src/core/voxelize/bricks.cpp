// SPDX-License-Identifier: MIT
#include "core/voxelize/bricks.h"

#include "core/base/clamped_count.h"
#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "core/voxelize/voxelize.h"
#include "voxelize/window.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace zvo
{

namespace
{

constexpr std::uint64_t kCapacityMin = 1024;
constexpr std::uint64_t kCapacityGuessMax = 1 << 21;
constexpr std::uint64_t kItemsMin = 1 << 14;
constexpr std::uint64_t kItemsGuessMax = 1 << 25;

std::uint32_t groupOn(const vk::Device& device)
{
    return tunedValue(device, Tunable::BrickThreads);
}

// The voxels of a brick whose sums are in shared memory at once, beside the masks, their ranks and the sums of
// subgroups.
std::uint32_t sumVoxelsOn(const vk::Device& device)
{
    constexpr std::uint32_t kOtherWords = 2 * gpu::kBrickWords + 128 + 1;
    constexpr std::uint32_t kWordsOfSums = 7;
    const std::uint32_t words = device.limits().maxComputeSharedMemorySize / sizeof(gpu::uint);
    return std::min(tunedValue(device, Tunable::BrickVoxels), (words - kOtherWords) / kWordsOfSums);
}

// The most items of a unit. Lavapipe ends the loops of a thread at 65,535 rounds: for each of its items, as often as a
// brick's voxels have to be taken in parts, those over the columns, over the texture's levels, and over the voxels.
std::uint32_t unitItems(const vk::Device& device)
{
    constexpr std::uint64_t kItemsOfThread = 64;
    constexpr std::uint64_t kRoundsMax = 50000;
    constexpr std::uint64_t kRoundsOfItem = 3 * gpu::kItemColumns;
    const std::uint64_t parts = divideUp(gpu::kBrickWords * 32, sumVoxelsOn(device));
    return static_cast<std::uint32_t>(std::min(kItemsOfThread, kRoundsMax / (kRoundsOfItem * parts))) * groupOn(device);
}

// The class that all materials of a scene belong to.
MaterialClass classOf(const GpuScene& scene)
{
    for (const MaterialClass material_class : {MaterialClass::Alpha, MaterialClass::Textured})
    {
        if (scene.chunksOf(material_class).workgroups() != 0)
        {
            return material_class;
        }
    }
    return MaterialClass::Plain;
}

// With `writes`, items are written that a run without has counted.
gpu::BinParams binParams(vk::AnyPass& pass, const BrickJob& job, bool writes)
{
    BrickBuffers& buffers = job.buffers;
    gpu::BinParams params{};
    params.scene = job.scene.read(pass);
    params.bricks = pass.accumulate(buffers.table);
    if (writes)
    {
        params.items = pass.accumulate(buffers.items);
        params.counters = {pass.read(buffers.counters).address};
    }
    else
    {
        params.counters = pass.readWrite(buffers.counters);
    }
    params.origin = job.tile.grid.origin;
    params.lattice_scale = latticeScale(job.tile.grid);
    params.window = gpu::packWindow(job.tile.grid.depth, job.tile.depth, job.tile.index);
    params.brick_mask = static_cast<std::uint32_t>(buffers.table.count() - 1);
    params.large_capacity = static_cast<std::uint32_t>(buffers.large.count());
    params.item_capacity = static_cast<std::uint32_t>(buffers.items.count());
    return params;
}

void binChunks(vk::FrameGraph& graph, const BrickJob& job, const vk::BufferOf<gpu::Chunk>& chunks, bool single,
               bool writes)
{
    if (chunks.count() == 0)
    {
        return;
    }
    vk::Pass pass = graph.addPass(gpu::voxelize::Bin{.wide_keys = hasWideKeys(job.tile.grid),
                                                     .writes = writes,
                                                     .single = single,
                                                     .block_lanes = tunedValue(graph.device(), Tunable::BandLanes)});
    gpu::BinParams params = binParams(pass, job, writes);
    if (!writes)
    {
        params.large = pass.accumulate(job.buffers.large);
    }
    params.chunks = pass.read(chunks);
    params.chunk_count = static_cast<std::uint32_t>(chunks.count());
    pass.dispatch(single ? chunks.count() : chunks.count() * gpu::kChunkTriangles, params);
}

void binAll(vk::FrameGraph& graph, const BrickJob& job, bool writes)
{
    for (const TriangleChunks& chunks : job.scene.uploaded().chunks)
    {
        binChunks(graph, job, chunks.whole, false, writes);
        binChunks(graph, job, chunks.single, true, writes);
    }
    const std::uint32_t lanes = tunedValue(graph.device(), Tunable::BandLanes);
    vk::Pass pass = graph.addPass(
        gpu::voxelize::BinLarge{.wide_keys = hasWideKeys(job.tile.grid), .writes = writes, .block_lanes = lanes});
    gpu::BinParams params = binParams(pass, job, writes);
    params.large = {pass.read(job.buffers.large).address};
    pass.dispatchIndirect(job.buffers.counters, &gpu::BinCounters::large, params,
                          divideUp(job.buffers.large.count() * lanes, gpu::kLargeGroup));
}

} // namespace

BrickCapacities BrickCapacities::estimate(const GpuScene& scene, const Grid& grid)
{
    const double leaves = VoxelizeEstimate::of(scene, grid, {}).leaves;
    const auto triangles = static_cast<double>(scene.triangle_count);
    const double area = leaves * gpu::kItemColumns / 1.5; // as leaves are estimated
    // A triangle of a columns has about a / 16 items, 0.75 sqrt(a) along its edges, and one. A surface crosses a brick
    // in 14 leaves or more.
    const double items = 1.15 * leaves + 0.75 * std::sqrt(triangles * area) + triangles;
    const double large = std::min(triangles, area / 6);
    BrickCapacities result;
    result.bricks = clampedCount(leaves / 10, kCapacityMin, kCapacityGuessMax);
    result.entries = std::bit_ceil(result.bricks * 2); // with the nodes above, no more than two thirds full
    result.items = clampedCount(items * 1.05, kItemsMin, kItemsGuessMax);
    result.large = clampedCount(large, kCapacityMin, kCapacityGuessMax);
    return result;
}

std::uint64_t BrickCapacities::bytes() const
{
    return entries * (sizeof(gpu::BrickEntry) + sizeof(gpu::WorkItem)) +
           items * (sizeof(gpu::BrickItem) + sizeof(gpu::ItemVoxels)) + large * sizeof(gpu::LargeBlock) +
           bricks * (sizeof(gpu::BrickRange) + sizeof(gpu::BrickUnit) + 2 * sizeof(gpu::uint) +
                     gpu::kBrickWords * sizeof(gpu::uint));
}

BrickBuffers::BrickBuffers(vk::Device& device, const BrickCapacities& capacities)
    : table(device, "voxelize/bricks", capacities.entries), ranges(device, "voxelize/brick_ranges", capacities.bricks),
      units(device, "voxelize/brick_units", capacities.bricks + capacities.items / unitItems(device)),
      items(device, "voxelize/items", capacities.items), voxels(device, "voxelize/item_voxels", capacities.items),
      large(device, "voxelize/large_blocks", capacities.large),
      masks(device, "voxelize/brick_masks", capacities.bricks * gpu::kBrickWords),
      counters(device, "voxelize/bin_counters", 1), nodes(device, "voxelize/brick_counters", 1),
      work_bricks(device, "voxelize/work_bricks", capacities.bricks),
      order(device, "voxelize/brick_order", capacities.bricks),
      partials(device, "voxelize/partials", divideUp(capacities.bricks, gpu::kScanBlock)),
      total(device, "voxelize/total", 1)
{
}

bool suitsBricks(const GpuScene& scene, const Grid& grid, Coverage coverage)
{
    return coverage == Coverage::Thin && scene.draws.count() < 1ULL << gpu::kItemTileShift && grid.nodeLevels() >= 2 &&
           scene.has_attributes && !(scene.emission_scale > 0.0F);
}

void coverBricks(vk::FrameGraph& graph, const BrickJob& job)
{
    BrickBuffers& buffers = job.buffers;
    const bool wide = hasWideKeys(job.tile.grid);
    const std::uint32_t max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    graph.fill(buffers.table, 0);
    graph.fill(buffers.counters, 0);
    graph.fill(buffers.nodes, 0);
    binAll(graph, job, false);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::ListBricks{});
        pass.dispatch(divideUp(buffers.table.count(), gpu::kListItems),
                      {.bricks = pass.readWrite(buffers.table),
                       .ranges = pass.write(buffers.ranges),
                       .units = pass.write(buffers.units),
                       .masks = pass.write(buffers.masks),
                       .counters = pass.readWrite(buffers.counters),
                       .brick_capacity = static_cast<std::uint32_t>(buffers.table.count()),
                       .max_groups_x = max_groups_x,
                       .range_capacity = static_cast<std::uint32_t>(buffers.ranges.count()),
                       .item_capacity = static_cast<std::uint32_t>(buffers.items.count()),
                       .unit_items = unitItems(graph.device()),
                       .large_capacity = static_cast<std::uint32_t>(buffers.large.count())});
    }
    binAll(graph, job, true);
    const std::uint32_t threads = groupOn(graph.device());
    vk::Pass pass = graph.addPass(gpu::voxelize::Cover{
        .wide_keys = wide, .local_size_x = threads, .material_class = classOf(job.scene.uploaded())});
    readColorTables(pass, job.scene.uploaded());
    pass.dispatchIndirect(buffers.counters, &gpu::BinCounters::cover,
                          {.scene = job.scene.read(pass),
                           .bricks = pass.readWrite(buffers.table),
                           .ranges = pass.readWrite(buffers.ranges),
                           .units = pass.read(buffers.units),
                           .items = pass.read(buffers.items),
                           .voxels = pass.write(buffers.voxels),
                           .masks = pass.readWrite(buffers.masks),
                           .counters = pass.read(buffers.counters),
                           .origin = job.tile.grid.origin,
                           .lattice_scale = latticeScale(job.tile.grid),
                           .window = gpu::packWindow(job.tile.grid.depth, job.tile.depth, job.tile.index)},
                          buffers.units.count());
}

void shadeBricks(vk::FrameGraph& graph, const BrickJob& job, const vk::BufferOf<gpu::WorkItem>& work,
                 std::uint32_t unit_count, AttributeBuffers& attributes, DeviceTree& octree)
{
    BrickBuffers& buffers = job.buffers;
    const bool wide = hasWideKeys(job.tile.grid);
    const auto [first_node, brick_count] = octree.levels[octree.levels.size() - 2];
    const std::uint64_t block_count = divideUp(brick_count, gpu::kScanBlock);
    constexpr std::uint64_t kBlocksUnscanned = 512;
    graph.fill(buffers.partials, 0);
    graph.fill(attributes.max_fragments, 0);
    graph.fill(attributes.sums, 0);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::PlaceBricks{.wide_keys = wide});
        pass.dispatch(brick_count, {.bricks = pass.read(buffers.table),
                                    .ranges = pass.read(buffers.ranges),
                                    .work = pass.read(work),
                                    .work_bricks = pass.read(buffers.work_bricks),
                                    .order = pass.write(buffers.order),
                                    .partials = pass.readWrite(buffers.partials),
                                    .first_node = first_node,
                                    .brick_count = brick_count});
    }
    if (block_count > kBlocksUnscanned)
    {
        vk::Pass pass = graph.addPass(gpu::octree::Scan{});
        pass.dispatch(gpu::kScanGroup, {.values = pass.readWrite(buffers.partials),
                                        .total = pass.write(buffers.total),
                                        .count = static_cast<std::uint32_t>(block_count)});
    }
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::BrickBases{});
        pass.dispatch(divideUp(brick_count, gpu::kAssignItems), {.ranges = pass.readWrite(buffers.ranges),
                                                                 .order = pass.read(buffers.order),
                                                                 .partials = pass.read(buffers.partials),
                                                                 .is_scanned = block_count > kBlocksUnscanned ? 1U : 0U,
                                                                 .brick_count = brick_count});
    }
    const std::uint32_t threads = groupOn(graph.device());
    vk::Pass pass = graph.addPass(gpu::voxelize::Attributes{.wide_keys = wide,
                                                            .local_size_x = threads,
                                                            .material_class = classOf(job.scene.uploaded()),
                                                            .sum_voxels = sumVoxelsOn(graph.device())});
    readColorTables(pass, job.scene.uploaded());
    pass.dispatch(std::uint64_t{unit_count} * threads,
                  {.scene = job.scene.read(pass),
                   .bricks = pass.read(buffers.table),
                   .ranges = pass.readWrite(buffers.ranges),
                   .units = pass.read(buffers.units),
                   .items = pass.read(buffers.items),
                   .voxels = pass.read(buffers.voxels),
                   .masks = pass.read(buffers.masks),
                   .sums = pass.readWrite(attributes.sums),
                   .nodes = pass.readWrite(octree.nodes),
                   .attributes = pass.write(octree.voxel_attributes),
                   .max_fragments = pass.readWrite(attributes.max_fragments),
                   .origin = job.tile.grid.origin,
                   .lattice_scale = latticeScale(job.tile.grid),
                   .window = gpu::packWindow(job.tile.grid.depth, job.tile.depth, job.tile.index),
                   .unit_count = unit_count,
                   .sum_shift = attributes.sum_shift});
}

} // namespace zvo
