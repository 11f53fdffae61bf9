// SPDX-License-Identifier: MIT
#include "core/voxelize/voxelize.h"

#include "core/base/clamped_count.h"
#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "core/tree/tree_limits.h"
#include "voxelize/window.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace zvo
{

static_assert(static_cast<gpu::uint>(Coverage::Conservative) == gpu::kCoverageConservative);
static_assert(static_cast<gpu::uint>(Coverage::Thin) == gpu::kCoverageThin);
static_assert(static_cast<gpu::uint>(Fill::Solid) == gpu::kFillSolid);
static_assert(static_cast<gpu::uint>(Fill::Parity) == gpu::kFillParity);
static_assert(static_cast<gpu::uint>(Fill::Robust) == gpu::kFillRobust);
static_assert(Grid::kDepthMax < 1U << gpu::kWindowDepthBits);
static_assert(GridTile::kTilesMax == 1U << gpu::kWindowIndexBits);
static_assert(1U << (2 * (Grid::kDepthMax - gpu::kBrickLog2 - gpu::kBlockLog2Max)) <= gpu::kBlocksMax);
static_assert(sizeof(gpu::BrickEntry) == gpu::kBrickBytes && sizeof(gpu::MixedVoxels) == gpu::kBrickBytes);
// What shaders/voxelize/loads.glsl puts together from words.
static_assert(sizeof(gpu::Draw) == gpu::kDrawWords * sizeof(gpu::uint));
static_assert(sizeof(gpu::Material) == 8 * sizeof(gpu::uint) && sizeof(gpu::TextureInfo) == 4 * sizeof(gpu::uint));
static_assert(sizeof(gpu::TextureLevel) == 3 * sizeof(gpu::uint));
// And setup.glsl, item_surface.glsl, item.glsl and attributes.glsl.
static_assert(sizeof(gpu::TriangleSetup) == 16 * sizeof(gpu::uint));
static_assert(sizeof(gpu::SurfaceSetup) == 16 * sizeof(gpu::uint));
static_assert(sizeof(gpu::BrickItem) == 2 * sizeof(gpu::uint) && sizeof(gpu::ItemVoxels) == 3 * sizeof(gpu::uint));

namespace
{

constexpr std::uint64_t kCountMin = 1024;
constexpr std::uint64_t kItemsMin = 1 << 12;
constexpr std::uint64_t kBricksGuessMax = 1 << 20; // the area may lie outside of the grid, for the most part
constexpr std::uint64_t kItemsGuessMax = 1 << 25;
// Kernels index quarters of a setup's surfaces, of which it has two with emission, an item's voxels, which are two with
// conservative coverage, and the words of a brick's masks, at most 256: kIndicesMax each. countable() checks those of
// crossings.
constexpr std::uint64_t kSetupsMax = 1ULL << 28;
constexpr std::uint64_t kItemsMax = 1ULL << 30;
constexpr std::uint64_t kBricksMax = 1ULL << 23;

// Whether fragments need what SurfaceSetup has.
bool hasSurfaces(const GpuScene& scene)
{
    return scene.highestClass() != MaterialClass::Plain || scene.colors.count() != 0;
}

// Whether items of small triangles are looked at again: to find or to shade their voxels, or to test their alpha.
bool needsSetups(const VoxelForm& form, const GpuScene& scene)
{
    return form.attributes || form.fill != Fill::None || form.coverage == Coverage::Conservative ||
           scene.highestClass() == MaterialClass::Alpha;
}

std::uint64_t surfacesOf(const VoxelForm& form, const GpuScene& scene, std::uint64_t setups)
{
    return hasSurfaces(scene) ? setups * (form.emission ? 2 : 1) : 0;
}

std::uint64_t voxelsOf(const VoxelForm& form, std::uint64_t items)
{
    return items * (form.coverage == Coverage::Conservative ? 2 : 1);
}

std::uint64_t maskWordsOf(const VoxelForm& form, std::uint64_t bricks)
{
    return bricks * gpu::kLeafMaskWords * (form.mixed ? 2 : 1);
}

std::uint32_t planesOf(const VoxelForm& form, const VoxelizeCapacities& capacities)
{
    return form.fill == Fill::None ? 0 : capacities.fill_planes;
}

std::uint64_t crossingWordsOf(const VoxelForm& form, const VoxelizeCapacities& capacities)
{
    return capacities.bricks *
           gpu::fillWords(planesOf(form, capacities), form.fill == Fill::Robust, form.shell == Shell::None);
}

// What is allocated has indices of 32 bits.
const VoxelForm& countable(const VoxelForm& form, const VoxelizeCapacities& capacities)
{
    if (std::max(maskWordsOf(form, capacities.bricks), crossingWordsOf(form, capacities)) > kIndicesMax)
    {
        throwUncountable("bricks");
    }
    return form;
}

// Threads of voxelize/fill a brick.
std::uint32_t fillLanes(const VoxelForm& form)
{
    return gpu::kFillLanes * (form.fill == Fill::Robust ? gpu::kFillAxes : 1);
}

// Threads that share a block. In deep grids blocks may have 64^2 columns of bricks, for each of which a thread runs
// some dozens of iterations; software devices stop loops silently at 65,535.
std::uint32_t blockLanes(const vk::Device& device, const Grid& grid)
{
    constexpr std::uint32_t kDepthOfLargeBlocks = 16;
    constexpr std::uint32_t kLanesOfLargeBlocks = 16;
    const std::uint32_t tuned = tunedValue(device, Tunable::BlockLanes);
    return grid.depth < kDepthOfLargeBlocks ? tuned : std::max(tuned, kLanesOfLargeBlocks);
}

std::uint32_t count32(const auto& buffer)
{
    return static_cast<std::uint32_t>(buffer.count());
}

// Records the pass over `count` chunks from `first` on. single: they are of one triangle each.
void binChunks(vk::FrameGraph& graph, const VoxelizeJob& job, MaterialClass material_class,
               const vk::BufferOf<gpu::Chunk>& chunks, std::uint64_t first, std::uint64_t count, bool single)
{
    VoxelizeBuffers& buffers = job.buffers;
    const VoxelForm& form = buffers.form;
    const Grid& grid = job.tile.grid;
    vk::Pass pass =
        graph.addPass(gpu::voxelize::Bin{.wide_keys = hasWideKeys(grid),
                                         .single = single,
                                         .block_lanes = blockLanes(graph.device(), grid),
                                         .material_class = material_class,
                                         .coverage = form.coverage,
                                         .mode = form.attributes ? RasterMode::Attributes : RasterMode::Coverage,
                                         .emits = form.emission,
                                         .keeps_setups = needsSetups(form, job.scene.uploaded())});
    readColorTables(pass, job.scene.uploaded());
    gpu::BinParams params{};
    params.scene = job.scene.read(pass);
    params.chunks = pass.read(chunks);
    params.chunks.address += first * sizeof(gpu::Chunk);
    params.setups = pass.accumulate(buffers.setups); // each element once, in any order
    params.surfaces = pass.accumulate(buffers.surfaces);
    params.bricks = pass.accumulate(buffers.table);
    params.items = pass.accumulate(buffers.items);
    params.voxels = pass.accumulate(buffers.voxels);
    params.large = pass.accumulate(buffers.large);
    params.counters = pass.readWrite(buffers.counters);
    params.origin = grid.origin;
    params.lattice_scale = latticeScale(grid);
    params.lattice_offset = job.lattice_offset;
    params.window = windowOf(job.tile);
    params.brick_mask = count32(buffers.table) - 1;
    params.chunk_count = static_cast<std::uint32_t>(count);
    params.setup_capacity = count32(buffers.setups);
    params.large_capacity = count32(buffers.large);
    params.item_capacity = count32(buffers.items);
    pass.dispatch(single ? count : count * gpu::kChunkTriangles, params);
}

void binLarge(vk::FrameGraph& graph, const VoxelizeJob& job)
{
    VoxelizeBuffers& buffers = job.buffers;
    const std::uint32_t lanes = blockLanes(graph.device(), job.tile.grid);
    vk::Pass pass = graph.addPass(gpu::voxelize::BinLarge{
        .wide_keys = hasWideKeys(job.tile.grid), .block_lanes = lanes, .coverage = buffers.form.coverage});
    pass.dispatchIndirect(buffers.counters, &gpu::BinCounters::large,
                          {.setups = pass.read(buffers.setups),
                           .large = pass.read(buffers.large),
                           .bricks = pass.accumulate(buffers.table),
                           .items = pass.accumulate(buffers.items), // each element once, in any order
                           .voxels = pass.accumulate(buffers.voxels),
                           .counters = pass.readWrite(buffers.counters),
                           .window = windowOf(job.tile),
                           .brick_mask = count32(buffers.table) - 1,
                           .setup_capacity = count32(buffers.setups),
                           .large_capacity = count32(buffers.large),
                           .item_capacity = count32(buffers.items)},
                          divideUp(buffers.large.count() * lanes, gpu::kLargeGroup));
}

// args: of the workgroups for items whose voxels are known, or for the others.
void coverItems(vk::FrameGraph& graph, const VoxelizeJob& job, bool known, gpu::DispatchArgs gpu::BinCounters::*args)
{
    VoxelizeBuffers& buffers = job.buffers;
    vk::Pass pass = graph.addPass(gpu::voxelize::Cover{.wide_keys = hasWideKeys(job.tile.grid),
                                                       .mixed = buffers.form.mixed,
                                                       .known = known,
                                                       .material_class = job.scene.uploaded().highestClass(),
                                                       .coverage = buffers.form.coverage,
                                                       .emits = buffers.form.emission,
                                                       .fill_planes = buffers.fill_planes,
                                                       .robust = buffers.form.fill == Fill::Robust,
                                                       .centres = buffers.form.shell == Shell::None});
    readColorTables(pass, job.scene.uploaded());
    const gpu::Ptr<gpu::BinCounters> counters = buffers.fill_planes != 0
                                                    ? pass.accumulate(buffers.counters)
                                                    : gpu::Ptr<gpu::BinCounters>{pass.read(buffers.counters).address};
    pass.dispatchIndirect(buffers.counters, args,
                          {.scene = job.scene.read(pass),
                           .setups = pass.read(buffers.setups),
                           .surfaces = pass.read(buffers.surfaces),
                           .bricks = pass.read(buffers.table),
                           .items = pass.read(buffers.items),
                           .voxels = pass.accumulate(buffers.voxels), // a thread its own
                           .masks = pass.accumulate(buffers.masks),
                           .crossings = pass.accumulate(buffers.crossings),
                           .counters = counters,
                           .window = windowOf(job.tile)},
                          divideUp(buffers.items.count(), gpu::kItemsGroup));
}

} // namespace

VoxelizeEstimate VoxelizeEstimate::of(const GpuScene& scene, const Grid& grid, Coverage coverage)
{
    const double voxel = grid.voxel_size;
    const double area = scene.surface_area / (voxel * voxel);
    const double grid_leaves = std::pow(std::max(static_cast<double>(grid.resolution()) / 4, 1.0), 3);
    const auto triangles = static_cast<double>(scene.triangle_count);
    VoxelizeEstimate result;
    result.leaves = std::min(area * 1.5 / 16, grid_leaves); // a plane meets about 1.5 per 16 voxels of area
    result.bricks = result.leaves / 10;                     // a surface crosses a brick in 14 leaves or more
    // Thin coverage leaves a triangle without voxels where no line through voxels' centres meets it: it has a fragment
    // for each unit of its area, or less.
    result.setups = coverage == Coverage::Thin ? std::min(triangles, area) : triangles;
    // A triangle of a columns has about a / 16 items, 0.75 sqrt(a) along its edges, and one.
    result.items = 1.15 * result.leaves + 0.75 * std::sqrt(result.setups * area) + result.setups;
    result.large = std::min(triangles, area / 6);
    return result;
}

VoxelizeCapacities VoxelizeCapacities::estimate(const GpuScene& scene, const Grid& grid, Coverage coverage)
{
    const VoxelizeEstimate likely = VoxelizeEstimate::of(scene, grid, coverage);
    VoxelizeCapacities result;
    result.bricks = clampedCount(likely.bricks, kCountMin, kBricksGuessMax);
    result.table = std::bit_ceil(2 * result.bricks); // with the nodes above, no more than two thirds full
    result.setups = clampedCount(likely.setups * 1.05, kCountMin, kItemsGuessMax);
    result.items = clampedCount(likely.items * 1.05, kItemsMin, kItemsGuessMax);
    result.large = clampedCount(likely.large, kCountMin, kBricksGuessMax);
    return result;
}

const char* VoxelizeCapacities::uncountable(const gpu::BinCounters& counters) const
{
    if (counters.blocks_exceeded != 0)
    {
        return "pieces of large triangles";
    }
    if (counters.crossings_exceeded != 0 && fill_planes >= gpu::kFillPlanesMax)
    {
        return "surfaces, one above the other";
    }
    if (counters.item_carry != 0 || counters.item_count > kItemsMax || counters.setup_count > kSetupsMax)
    {
        return "pieces of triangles";
    }
    const bool is_full = counters.overflow_count != 0 && table >= kTableMax;
    return counters.brick_count > kBricksMax || is_full ? "octree nodes" : nullptr;
}

VoxelizeCapacities VoxelizeCapacities::grownFor(const gpu::BinCounters& counters) const
{
    if (const char* what = uncountable(counters))
    {
        throwUncountable(what);
    }
    VoxelizeCapacities grown = *this;
    grown.bricks = std::max<std::uint64_t>(bricks, counters.brick_count);
    grown.setups = std::max<std::uint64_t>(setups, counters.setup_count);
    grown.items = std::max<std::uint64_t>(items, counters.item_count);
    grown.large = std::max<std::uint64_t>(large, counters.large_count);
    grown.table = std::max(table, std::bit_ceil(2 * grown.bricks));
    if (counters.crossings_exceeded != 0)
    {
        grown.fill_planes = std::min(2 * fill_planes, gpu::kFillPlanesMax);
    }
    if (counters.overflow_count != 0)
    {
        grown.table = std::min(std::max(grown.table, 4 * table), kTableMax);
    }
    return grown;
}

std::uint64_t VoxelizeCapacities::bytes(const GpuScene& scene, const VoxelForm& form) const
{
    return table * sizeof(gpu::BrickEntry) + setups * sizeof(gpu::TriangleSetup) +
           surfacesOf(form, scene, setups) * sizeof(gpu::SurfaceSetup) + items * sizeof(gpu::BrickItem) +
           voxelsOf(form, items) * sizeof(gpu::ItemVoxels) + large * sizeof(gpu::LargeBlock) +
           bricks * sizeof(gpu::BrickRange) +
           (maskWordsOf(form, bricks) + crossingWordsOf(form, *this)) * sizeof(gpu::uint);
}

VoxelizeBuffers::VoxelizeBuffers(vk::Device& device, const VoxelizeCapacities& capacities, const GpuScene& scene,
                                 const VoxelForm& voxel_form)
    : form(countable(voxel_form, capacities)), table(device, "voxelize/bricks", capacities.table),
      setups(device, "voxelize/setups", capacities.setups),
      surfaces(device, "voxelize/surfaces", surfacesOf(form, scene, capacities.setups)),
      items(device, "voxelize/items", capacities.items),
      voxels(device, "voxelize/item_voxels", voxelsOf(form, capacities.items)),
      large(device, "voxelize/large_blocks", capacities.large),
      ranges(device, "voxelize/brick_ranges", capacities.bricks),
      masks(device, "voxelize/brick_masks", maskWordsOf(form, capacities.bricks)),
      fill_planes(planesOf(form, capacities)),
      crossings(device, "voxelize/crossings", crossingWordsOf(form, capacities)),
      counters(device, "voxelize/bin_counters", 1)
{
    assert(std::has_single_bit(capacities.table));
}

VoxelizeBuffers::VoxelizeBuffers(vk::Device& device, const VoxelizeCapacities& capacities, const VoxelForm& voxel_form)
    : form(countable(voxel_form, capacities)), table(device, "voxelize/bricks", capacities.table),
      ranges(device, "voxelize/brick_ranges", capacities.bricks),
      masks(device, "voxelize/brick_masks", maskWordsOf(form, capacities.bricks)),
      fill_planes(planesOf(form, capacities)),
      crossings(device, "voxelize/crossings", crossingWordsOf(form, capacities)),
      counters(device, "voxelize/bin_counters", 1)
{
    assert(std::has_single_bit(capacities.table));
}

std::map<std::string, std::uint64_t> droppedTriangles(const gpu::BinCounters& counters)
{
    std::map<std::string, std::uint64_t> dropped = {{"nonfinite", counters.nonfinite},
                                                    {"out_of_range", counters.out_of_range},
                                                    {"outside", counters.outside},
                                                    {"zero_area", counters.zero_area}};
    std::erase_if(dropped, [](const auto& entry) { return entry.second == 0; });
    return dropped;
}

std::uint32_t windowOf(const GridTile& tile)
{
    return gpu::packWindow(tile.grid.depth, tile.depth, tile.index);
}

void clearVoxels(vk::FrameGraph& graph, VoxelizeBuffers& buffers)
{
    graph.fill(buffers.table, 0);
    graph.fill(buffers.counters, 0);
    graph.fill(buffers.masks, 0);
    if (buffers.fill_planes != 0)
    {
        graph.fill(buffers.crossings, 0);
    }
}

void binTriangles(vk::FrameGraph& graph, const VoxelizeJob& job, MaterialClass material_class,
                  std::uint64_t first_group, std::uint64_t group_count)
{
    assert(job.scene.uploaded().texture_grid.value_or(job.tile.grid) == job.tile.grid);
    const TriangleChunks& chunks = job.scene.uploaded().chunksOf(material_class);
    const std::uint64_t end = first_group + group_count;
    const std::uint64_t whole_end = std::min(end, chunks.whole.count());
    if (first_group < whole_end)
    {
        binChunks(graph, job, material_class, chunks.whole, first_group, whole_end - first_group, false);
    }
    if (end > chunks.whole.count())
    {
        const std::uint64_t first_single = std::max(first_group, chunks.whole.count()) - chunks.whole.count();
        const std::uint64_t first = first_single * gpu::kChunkTriangles;
        const std::uint64_t single_end =
            std::min((end - chunks.whole.count()) * gpu::kChunkTriangles, chunks.single.count());
        binChunks(graph, job, material_class, chunks.single, first, single_end - first, true);
    }
}

void listBricks(vk::FrameGraph& graph, VoxelizeBuffers& buffers, std::uint32_t brick_lanes)
{
    vk::Pass pass = graph.addPass(gpu::voxelize::ListBricks{.brick_lanes = brick_lanes});
    pass.dispatch(divideUp(buffers.table.count(), gpu::kListItems),
                  {.bricks = pass.readWrite(buffers.table),
                   .ranges = pass.write(buffers.ranges),
                   .counters = pass.readWrite(buffers.counters),
                   .brick_capacity = count32(buffers.table),
                   .max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0],
                   .range_capacity = count32(buffers.ranges),
                   .setup_capacity = count32(buffers.setups),
                   .item_capacity = count32(buffers.items),
                   .large_capacity = count32(buffers.large),
                   .fill_lanes = fillLanes(buffers.form)});
}

void coverBricks(vk::FrameGraph& graph, const VoxelizeJob& job)
{
    binLarge(graph, job);
    listBricks(graph, job.buffers, tunedValue(graph.device(), Tunable::BrickLanes));
    coverItems(graph, job, true, &gpu::BinCounters::known);
    coverItems(graph, job, false, &gpu::BinCounters::cover);
}

void fillBricks(vk::FrameGraph& graph, const VoxelizeJob& job)
{
    VoxelizeBuffers& buffers = job.buffers;
    if (buffers.fill_planes == 0)
    {
        return;
    }
    const bool wide = hasWideKeys(job.tile.grid);
    const std::uint32_t window = windowOf(job.tile);
    const bool robust = buffers.form.fill == Fill::Robust;
    const std::uint64_t groups = divideUp(buffers.ranges.count(), gpu::kBricksGroup);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::FillColumns{.wide_keys = wide, .robust = robust});
        pass.dispatchIndirect(buffers.counters, &gpu::BinCounters::collect,
                              {.bricks = pass.readWrite(buffers.table),
                               .ranges = pass.read(buffers.ranges),
                               .counters = pass.readWrite(buffers.counters),
                               .window = window,
                               .brick_mask = count32(buffers.table) - 1},
                              groups);
    }
    {
        const bool centres = buffers.form.shell == Shell::None;
        vk::Pass pass = graph.addPass(gpu::voxelize::FillVoxels{.wide_keys = wide,
                                                                .fill_planes = buffers.fill_planes,
                                                                .fill = buffers.form.fill,
                                                                .centres = centres,
                                                                .mixed = buffers.form.mixed});
        pass.dispatchIndirect(
            buffers.counters, &gpu::BinCounters::fill,
            {.bricks = pass.readWrite(buffers.table),
             .ranges = pass.read(buffers.ranges),
             .crossings = pass.readWrite(buffers.crossings),
             .masks = centres ? pass.readWrite(buffers.masks) : gpu::Ptr<gpu::uint>{pass.read(buffers.masks).address},
             .counters = pass.readWrite(buffers.counters),
             .window = window,
             .brick_mask = count32(buffers.table) - 1},
            groups * fillLanes(buffers.form));
    }
    if (robust)
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::FillVote{
            .wide_keys = wide, .mixed = buffers.form.mixed, .fill_planes = buffers.fill_planes});
        pass.dispatchIndirect(buffers.counters, &gpu::BinCounters::vote,
                              {.bricks = pass.readWrite(buffers.table),
                               .ranges = pass.read(buffers.ranges),
                               .masks = pass.read(buffers.masks),
                               .crossings = pass.readWrite(buffers.crossings),
                               .counters = pass.readWrite(buffers.counters),
                               .window = window,
                               .brick_mask = count32(buffers.table) - 1},
                              buffers.ranges.count());
    }
}

void voxelizeCoverage(vk::FrameGraph& graph, const VoxelizeJob& job)
{
    clearVoxels(graph, job.buffers);
    for (const MaterialClass material_class : kMaterialClasses)
    {
        binTriangles(graph, job, material_class, 0, job.scene.uploaded().chunksOf(material_class).workgroups());
    }
    coverBricks(graph, job);
    fillBricks(graph, job);
}

} // namespace zvo
