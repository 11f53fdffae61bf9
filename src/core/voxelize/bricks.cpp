// SPDX-License-Identifier: MIT
#include "core/voxelize/bricks.h"

#include "core/base/clamped_count.h"
#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "core/voxelize/voxelize.h"
#include "voxelize/window.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace zvo
{

namespace
{

constexpr std::uint64_t kCapacityMin = 1024;
constexpr std::uint64_t kCapacityGuessMax = 1 << 20; // the area may lie outside of the grid, for the most part
constexpr std::uint64_t kItemsMin = 1 << 14;
constexpr std::uint64_t kItemsGuessMax = 1 << 25;
constexpr std::uint64_t kSetupsMax = 1 << 30; // kernels count them in words of 16 bytes

// The highest class of a scene, whose kernels serve the others.
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

// The places of setups: those of whole chunks may be empty.
std::uint64_t setupCount(const GpuScene& scene)
{
    std::uint64_t count = 0;
    for (const TriangleChunks& chunks : scene.chunks)
    {
        count += chunks.whole.count() * gpu::kChunkTriangles + chunks.single.count();
    }
    return count;
}

// Those with textures or colours of vertices.
std::uint64_t surfaceCount(const GpuScene& scene)
{
    return classOf(scene) != MaterialClass::Plain || scene.colors.count() != 0 ? setupCount(scene) : 0;
}

// first_setup: of these chunks. Returns that of the next ones.
std::uint32_t binChunks(vk::FrameGraph& graph, const BrickJob& job, const vk::BufferOf<gpu::Chunk>& chunks, bool single,
                        MaterialClass material_class, std::uint32_t first_setup)
{
    assert(job.scene.uploaded().texture_grid.value_or(job.tile.grid) == job.tile.grid);
    const std::uint64_t triangles = single ? chunks.count() : chunks.count() * gpu::kChunkTriangles;
    if (triangles == 0)
    {
        return first_setup;
    }
    vk::Pass pass = graph.addPass(gpu::voxelize::Bin{.wide_keys = hasWideKeys(job.tile.grid),
                                                     .single = single,
                                                     .block_lanes = tunedValue(graph.device(), Tunable::BandLanes),
                                                     .material_class = material_class});
    readColorTables(pass, job.scene.uploaded());
    BrickBuffers& buffers = job.buffers;
    gpu::BinParams params{};
    params.scene = job.scene.read(pass);
    params.chunks = pass.read(chunks);
    params.setups = pass.accumulate(buffers.setups); // each element once, in any order
    params.surfaces = pass.accumulate(buffers.surfaces);
    params.bricks = pass.accumulate(buffers.table);
    params.items = pass.accumulate(buffers.items);
    params.voxels = pass.accumulate(buffers.voxels);
    params.large = pass.accumulate(buffers.large);
    params.counters = pass.readWrite(buffers.counters);
    params.origin = job.tile.grid.origin;
    params.lattice_scale = latticeScale(job.tile.grid);
    params.window = gpu::packWindow(job.tile.grid.depth, job.tile.depth, job.tile.index);
    params.brick_mask = static_cast<std::uint32_t>(buffers.table.count() - 1);
    params.chunk_count = static_cast<std::uint32_t>(chunks.count());
    params.first_setup = first_setup;
    params.large_capacity = static_cast<std::uint32_t>(buffers.large.count());
    params.item_capacity = static_cast<std::uint32_t>(buffers.items.count());
    pass.dispatch(triangles, params);
    return first_setup + static_cast<std::uint32_t>(triangles);
}

void binAll(vk::FrameGraph& graph, const BrickJob& job)
{
    std::uint32_t first_setup = 0;
    for (const MaterialClass material_class : kMaterialClasses)
    {
        const TriangleChunks& chunks = job.scene.uploaded().chunksOf(material_class);
        first_setup = binChunks(graph, job, chunks.whole, false, material_class, first_setup);
        first_setup = binChunks(graph, job, chunks.single, true, material_class, first_setup);
    }
    const std::uint32_t lanes = tunedValue(graph.device(), Tunable::BandLanes);
    BrickBuffers& buffers = job.buffers;
    vk::Pass pass =
        graph.addPass(gpu::voxelize::BinLarge{.wide_keys = hasWideKeys(job.tile.grid), .block_lanes = lanes});
    pass.dispatchIndirect(buffers.counters, &gpu::BinCounters::large,
                          {.setups = pass.read(buffers.setups),
                           .large = pass.read(buffers.large),
                           .bricks = pass.accumulate(buffers.table),
                           .items = pass.accumulate(buffers.items), // each element once, in any order
                           .voxels = pass.accumulate(buffers.voxels),
                           .counters = pass.readWrite(buffers.counters),
                           .window = gpu::packWindow(job.tile.grid.depth, job.tile.depth, job.tile.index),
                           .brick_mask = static_cast<std::uint32_t>(buffers.table.count() - 1),
                           .large_capacity = static_cast<std::uint32_t>(buffers.large.count()),
                           .item_capacity = static_cast<std::uint32_t>(buffers.items.count())},
                          divideUp(buffers.large.count() * lanes, gpu::kLargeGroup));
}

// args: of the workgroups for items of small or of large triangles.
void coverItems(vk::FrameGraph& graph, const BrickJob& job, bool small, gpu::DispatchArgs gpu::BinCounters::*args)
{
    BrickBuffers& buffers = job.buffers;
    vk::Pass pass = graph.addPass(gpu::voxelize::Cover{.wide_keys = hasWideKeys(job.tile.grid),
                                                       .mixed = buffers.has_mixed,
                                                       .small = small,
                                                       .material_class = classOf(job.scene.uploaded())});
    readColorTables(pass, job.scene.uploaded());
    pass.dispatchIndirect(buffers.counters, args,
                          {.scene = job.scene.read(pass),
                           .setups = pass.read(buffers.setups),
                           .surfaces = pass.read(buffers.surfaces),
                           .bricks = pass.read(buffers.table),
                           .items = pass.read(buffers.items),
                           .voxels = pass.accumulate(buffers.voxels), // a thread its own
                           .masks = pass.accumulate(buffers.masks),
                           .counters = pass.read(buffers.counters),
                           .window = gpu::packWindow(job.tile.grid.depth, job.tile.depth, job.tile.index)},
                          divideUp(buffers.items.count(), gpu::kItemsGroup));
}

template <typename Kernel>
void addAttributes(vk::FrameGraph& graph, const BrickJob& job, std::uint32_t item_count, AttributeBuffers& attributes,
                   DeviceTree& octree)
{
    BrickBuffers& buffers = job.buffers;
    vk::Pass pass = graph.addPass(Kernel{.wide_keys = hasWideKeys(job.tile.grid),
                                         .mixed = buffers.has_mixed,
                                         .material_class = classOf(job.scene.uploaded())});
    readColorTables(pass, job.scene.uploaded());
    pass.dispatch(item_count, {.scene = job.scene.read(pass),
                               .setups = pass.read(buffers.setups),
                               .surfaces = pass.read(buffers.surfaces),
                               .bricks = pass.read(buffers.table),
                               .items = pass.read(buffers.items),
                               .voxels = pass.read(buffers.voxels),
                               .nodes = pass.read(octree.nodes),
                               .mixed = pass.read(buffers.mixed),
                               .sums = pass.accumulate(attributes.sums),
                               .attributes = pass.write(octree.voxel_attributes),
                               .window = gpu::packWindow(job.tile.grid.depth, job.tile.depth, job.tile.index),
                               .first_leaf = octree.levels.back().first_node,
                               .item_count = item_count,
                               .sum_shift = attributes.sum_shift});
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
    result.setups = setupCount(scene);
    result.surfaces = surfaceCount(scene);
    return result;
}

std::uint64_t BrickCapacities::maskWords(bool mixed) const
{
    return bricks * gpu::kLeafMaskWords * (mixed ? 2 : 1);
}

std::uint64_t BrickCapacities::bytes(bool mixed) const
{
    return entries * (sizeof(gpu::BrickEntry) + sizeof(gpu::WorkItem)) + setups * sizeof(gpu::TriangleSetup) +
           surfaces * sizeof(gpu::SurfaceSetup) + items * (sizeof(gpu::BrickItem) + sizeof(gpu::ItemVoxels)) +
           large * sizeof(gpu::LargeBlock) + bricks * (sizeof(gpu::BrickRange) + 2 * sizeof(gpu::uint)) +
           maskWords(mixed) * sizeof(gpu::uint);
}

std::uint64_t BrickCapacities::largestBytes(bool mixed) const
{
    return std::max({entries * sizeof(gpu::BrickEntry), setups * sizeof(gpu::TriangleSetup),
                     items * sizeof(gpu::ItemVoxels), maskWords(mixed) * sizeof(gpu::uint)});
}

BrickBuffers::BrickBuffers(vk::Device& device, const BrickCapacities& capacities, bool of_mixed)
    : has_mixed(of_mixed), setups(device, "voxelize/setups", capacities.setups),
      surfaces(device, "voxelize/surfaces", capacities.surfaces), table(device, "voxelize/bricks", capacities.entries),
      ranges(device, "voxelize/brick_ranges", capacities.bricks), items(device, "voxelize/items", capacities.items),
      voxels(device, "voxelize/item_voxels", capacities.items),
      large(device, "voxelize/large_blocks", capacities.large),
      masks(device, "voxelize/brick_masks", capacities.maskWords(of_mixed)),
      counters(device, "voxelize/bin_counters", 1), nodes(device, "voxelize/brick_counters", 1),
      work_bricks(device, "voxelize/work_bricks", capacities.bricks),
      order(device, "voxelize/brick_order", capacities.bricks),
      partials(device, "voxelize/partials", divideUp(capacities.bricks, gpu::kScanBlock)),
      total(device, "voxelize/total", 1)
{
}

bool suitsBricks(const GpuScene& scene, const Grid& grid, Coverage coverage)
{
    return coverage == Coverage::Thin && setupCount(scene) <= kSetupsMax && grid.nodeLevels() >= 2 &&
           scene.has_attributes && !(scene.emission_scale > 0.0F);
}

void coverBricks(vk::FrameGraph& graph, const BrickJob& job)
{
    BrickBuffers& buffers = job.buffers;
    const std::uint32_t max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    graph.fill(buffers.table, 0);
    graph.fill(buffers.counters, 0);
    graph.fill(buffers.nodes, 0);
    graph.fill(buffers.masks, 0);
    binAll(graph, job);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::ListBricks{});
        pass.dispatch(divideUp(buffers.table.count(), gpu::kListItems),
                      {.bricks = pass.readWrite(buffers.table),
                       .ranges = pass.write(buffers.ranges),
                       .counters = pass.readWrite(buffers.counters),
                       .brick_capacity = static_cast<std::uint32_t>(buffers.table.count()),
                       .max_groups_x = max_groups_x,
                       .range_capacity = static_cast<std::uint32_t>(buffers.ranges.count()),
                       .item_capacity = static_cast<std::uint32_t>(buffers.items.count()),
                       .large_capacity = static_cast<std::uint32_t>(buffers.large.count())});
    }
    coverItems(graph, job, true, &gpu::BinCounters::small);
    coverItems(graph, job, false, &gpu::BinCounters::cover);
}

void prepareLeaves(vk::Device& device, const Grid& grid, const BrickBuffers& buffers)
{
    vk::KernelCache& kernels = device.kernels();
    kernels.get(gpu::voxelize::PlaceBricks{.wide_keys = hasWideKeys(grid)});
    kernels.get(gpu::octree::Scan{});
    kernels.get(gpu::voxelize::BrickBases{});
    kernels.get(gpu::voxelize::BrickLeaves{.wide_keys = hasWideKeys(grid), .mixed = buffers.has_mixed});
}

void placeLeaves(vk::FrameGraph& graph, const Grid& grid, BrickBuffers& buffers,
                 const vk::BufferOf<gpu::WorkItem>& work, DeviceTree& octree)
{
    const bool wide = hasWideKeys(grid);
    const auto [first_node, brick_count] = octree.levels[octree.levels.size() - 2];
    const std::uint64_t block_count = divideUp(brick_count, gpu::kScanBlock);
    constexpr std::uint64_t kBlocksUnscanned = 512;
    graph.fill(buffers.partials, 0);
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
    vk::Pass pass = graph.addPass(gpu::voxelize::BrickLeaves{.wide_keys = wide, .mixed = buffers.has_mixed});
    pass.dispatch(std::uint64_t{brick_count} * gpu::kBrickLeaves, {.bricks = pass.read(buffers.table),
                                                                   .ranges = pass.read(buffers.ranges),
                                                                   .order = pass.read(buffers.order),
                                                                   .masks = pass.read(buffers.masks),
                                                                   .nodes = pass.readWrite(octree.nodes),
                                                                   .mixed = pass.write(buffers.mixed),
                                                                   .first_leaf = octree.levels.back().first_node,
                                                                   .brick_count = brick_count});
}

void shadeBricks(vk::FrameGraph& graph, const BrickJob& job, std::uint32_t item_count, bool int64,
                 AttributeBuffers& attributes, DeviceTree& octree)
{
    BrickBuffers& buffers = job.buffers;
    const auto [first_leaf, leaf_count] = octree.levels.back();
    graph.fill(attributes.max_fragments, 0);
    graph.fill(attributes.sums, 0);
    if (int64)
    {
        addAttributes<gpu::voxelize::AttributesInt64>(graph, job, item_count, attributes, octree);
    }
    else
    {
        addAttributes<gpu::voxelize::Attributes>(graph, job, item_count, attributes, octree);
    }
    if (!buffers.has_mixed)
    {
        resolveVoxels(graph, job.scene.uploaded(), attributes, octree);
        return;
    }
    vk::Pass pass = graph.addPass(gpu::voxelize::ResolveLeaves{});
    readColorTables(pass, job.scene.uploaded());
    pass.dispatch(leaf_count, {.scene = job.scene.read(pass),
                               .nodes = pass.read(octree.nodes),
                               .mixed = pass.read(buffers.mixed),
                               .sums = pass.read(attributes.sums),
                               .attributes = pass.readWrite(octree.voxel_attributes),
                               .max_fragments = pass.readWrite(attributes.max_fragments),
                               .first_leaf = first_leaf,
                               .leaf_count = leaf_count,
                               .sum_shift = attributes.sum_shift});
}

} // namespace zvo
