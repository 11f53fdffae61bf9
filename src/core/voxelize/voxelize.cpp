// SPDX-License-Identifier: MIT
#include "core/voxelize/voxelize.h"

#include "core/base/clamped_count.h"
#include "core/base/divide_up.h"
#include "core/base/lanes.h"
#include "core/base/tuning.h"
#include "core/tree/device_tree.h"
#include "octree/octree.h"
#include "voxelize/window.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace zvo
{

static_assert(static_cast<gpu::uint>(Coverage::Conservative) == gpu::kCoverageConservative);
static_assert(static_cast<gpu::uint>(Coverage::Thin) == gpu::kCoverageThin);
static_assert(Grid::kDepthMax < 1U << gpu::kWindowDepthBits);
static_assert(GridTile::kTilesMax == 1U << gpu::kWindowIndexBits);
static_assert(sizeof(gpu::VoxelSums) == gpu::kVoxelSumsBytes);
static_assert(sizeof(gpu::BrickEntry) == gpu::kBrickBytes && sizeof(gpu::MixedVoxels) == gpu::kBrickBytes);
// What shaders/voxelize/loads.glsl and rows.glsl put together from words.
static_assert(sizeof(gpu::Draw) == gpu::kDrawWords * sizeof(gpu::uint));
static_assert(sizeof(gpu::Material) == 8 * sizeof(gpu::uint) && sizeof(gpu::TextureInfo) == 4 * sizeof(gpu::uint));
static_assert(sizeof(gpu::TextureLevel) == 3 * sizeof(gpu::uint));
static_assert(sizeof(gpu::BigTriangle) == 12 * sizeof(gpu::uint) && sizeof(gpu::RowBlock) == 2 * sizeof(gpu::uint));

namespace
{

constexpr std::string_view kInt64Atomics = "shaderBufferInt64Atomics";
constexpr std::uint64_t kBricksMin = 4096;
constexpr std::uint64_t kBricksGuessMax = 1 << 24; // the area may lie outside of the grid, for the most part
constexpr std::uint64_t kBigTrianglesMin = 1 << 12;
constexpr std::uint64_t kBigTrianglesGuessMax = 1 << 20;
constexpr std::uint64_t kRowBlocksMin = 1 << 16;
constexpr std::uint64_t kRowBlocksGuessMax = 1 << 23;

// The kernels of all modes share their parameters: those that only read a buffer get a writable address, too.
template <typename T> gpu::Ptr<T> access(vk::AnyPass& pass, vk::BufferOf<T>& buffer, bool writes)
{
    return writes ? pass.readWrite(buffer) : gpu::Ptr<T>{pass.read(buffer).address};
}

// The same for what threads add up by atomics, whatever class of triangles they walk.
template <typename T> gpu::Ptr<T> accumulation(vk::AnyPass& pass, vk::BufferOf<T>& buffer, bool writes)
{
    return writes ? pass.accumulate(buffer) : gpu::Ptr<T>{pass.read(buffer).address};
}

gpu::RasterParams rasterParams(vk::AnyPass& pass, const RasterWalk& walk, MaterialClass material_class)
{
    assert(walk.job.scene.uploaded().texture_grid.value_or(walk.job.tile.grid) == walk.job.tile.grid);
    const bool covers = walk.mode == RasterMode::Coverage; // lists and table are made then, and only read afterwards
    VoxelizeBuffers::RowWork& rows = walk.job.buffers.rowsOf(material_class);
    gpu::RasterParams params{};
    params.scene = walk.job.scene.read(pass);
    readColorTables(pass, walk.job.scene.uploaded());
    params.bricks = accumulation(pass, walk.job.buffers.bricks, covers);
    params.big_triangles = access(pass, rows.big_triangles, covers);
    params.row_blocks = access(pass, rows.row_blocks, covers);
    params.counters = access(pass, rows.counters, covers);
    params.origin = walk.job.tile.grid.origin;
    params.lattice_scale = latticeScale(walk.job.tile.grid);
    params.window = gpu::packWindow(walk.job.tile.grid.depth, walk.job.tile.depth, walk.job.tile.index);
    params.brick_mask = static_cast<std::uint32_t>(walk.job.buffers.brickCapacity() - 1);
    params.big_capacity = static_cast<std::uint32_t>(rows.big_triangles.count());
    params.block_capacity = static_cast<std::uint32_t>(rows.row_blocks.count());
    if (!covers)
    {
        const bool emits = walk.mode == RasterMode::Emission;
        params.nodes = pass.read(walk.sums->leaves);
        params.sums = accumulation(pass, walk.sums->sums, !emits);
        params.emission_words = accumulation(pass, walk.sums->emission_words, !emits);
        params.emission_sums = accumulation(pass, walk.sums->emission_sums, emits);
        params.sum_shift = walk.sums->sum_shift;
        if (walk.job.buffers.sum_form.mixed && !emits)
        {
            params.attributes = pass.accumulate(*walk.sums->attributes); // each element once, in any order
        }
    }
    return params;
}

// The variant of a raster kernel for a walk over a material class.
template <typename Kernel> Kernel rasterKernel(const RasterWalk& walk, MaterialClass material_class)
{
    const bool emits = walk.mode != RasterMode::Coverage && walk.sums->emission_words.count() != 0;
    const RowShape shape = walk.job.buffers.shape;
    Kernel kernel{.coverage = walk.job.coverage,
                  .mode = walk.mode,
                  .material_class = material_class,
                  .emits = emits,
                  .block_columns = shape.block_columns,
                  .strip_lanes = shape.strip_lanes};
    if constexpr (requires { kernel.wide_keys; })
    {
        kernel.wide_keys = hasWideKeys(walk.job.tile.grid);
    }
    if constexpr (requires { kernel.mixed; })
    {
        kernel.mixed = walk.mode != RasterMode::Emission && walk.job.buffers.sum_form.mixed;
    }
    return kernel;
}

// Calls record with the variant of a raster kernel for a walk, or of its form for devices with 64-bit atomics.
template <typename Kernel, typename Int64Kernel, typename Record>
void recordRaster(const RasterWalk& walk, MaterialClass material_class, const Record& record)
{
    if (walk.mode == RasterMode::Attributes && walk.job.buffers.sum_form.int64)
    {
        record(rasterKernel<Int64Kernel>(walk, material_class));
        return;
    }
    record(rasterKernel<Kernel>(walk, material_class));
}

// Records the pass over `count` chunks from `first` on. single: they are of one triangle each.
void walkChunks(vk::FrameGraph& graph, const RasterWalk& walk, MaterialClass material_class,
                const vk::BufferOf<gpu::Chunk>& chunks, std::uint64_t first, std::uint64_t count, bool single)
{
    const auto record = [&](auto kernel)
    {
        kernel.single = single;
        vk::Pass pass = graph.addPass(kernel);
        gpu::RasterParams params = rasterParams(pass, walk, material_class);
        params.chunks = pass.read(chunks);
        params.chunks.address += first * sizeof(gpu::Chunk);
        params.chunk_count = static_cast<std::uint32_t>(count);
        pass.dispatch(single ? count : count * gpu::kChunkTriangles, params);
    };
    recordRaster<gpu::voxelize::Triangles, gpu::voxelize::TrianglesInt64>(walk, material_class, record);
}

// Walks the triangles of all classes; in coverage mode the big ones are listed on the way, later modes use that list.
// Passes of different classes need no barriers between them.
void walkAll(vk::FrameGraph& graph, const RasterWalk& walk)
{
    for (const MaterialClass material_class : kMaterialClasses)
    {
        walkTriangles(graph, walk, material_class, 0, walk.job.scene.uploaded().chunksOf(material_class).workgroups());
    }
    for (const MaterialClass material_class : kMaterialClasses)
    {
        listRows(graph, walk, material_class);
    }
    for (const MaterialClass material_class : kMaterialClasses)
    {
        walkRows(graph, walk, material_class);
    }
}

void rankEmissiveVoxels(vk::FrameGraph& graph, AttributeBuffers& attributes, DeviceTree& octree)
{
    const auto word_count = static_cast<std::uint32_t>(octree.emission_words.count());
    const std::uint64_t threads = divideUp(word_count, gpu::kScanItems);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::EmissionCount{});
        const gpu::EmissionRankParams params = {pass.readWrite(octree.emission_words), pass.write(attributes.partials),
                                                word_count};
        pass.dispatch(threads, params);
    }
    {
        vk::Pass pass = graph.addPass(gpu::octree::Scan{});
        const gpu::ScanParams params = {pass.readWrite(attributes.partials), pass.write(attributes.emissive_count),
                                        static_cast<std::uint32_t>(divideUp(word_count, gpu::kScanBlock))};
        pass.dispatch(gpu::kScanGroup, params);
    }
    vk::Pass pass = graph.addPass(gpu::voxelize::EmissionRank{});
    const gpu::EmissionRankParams params = {pass.readWrite(octree.emission_words), pass.readWrite(attributes.partials),
                                            word_count};
    pass.dispatch(threads, params);
}

void resolveMixed(vk::FrameGraph& graph, const VoxelizeJob& job, const vk::BufferOf<gpu::WorkItem>& leaves,
                  AttributeBuffers& attributes, DeviceTree& octree)
{
    const std::uint32_t leaf_count = octree.levels.back().node_count;
    const std::uint32_t lanes = lanesOn(graph.device(), leaf_count);
    vk::Pass pass = graph.addPass(gpu::voxelize::ResolveMixed{.wide_keys = hasWideKeys(job.tile.grid), .lanes = lanes});
    pass.dispatch(std::uint64_t{leaf_count} * lanes,
                  {.scene = readColorTables(pass, job.scene.uploaded()),
                   .bricks = pass.read(job.buffers.bricks),
                   .items = pass.read(leaves),
                   .nodes = pass.read(octree.nodes),
                   .sums = pass.read(attributes.sums),
                   .attributes = pass.readWrite(octree.voxel_attributes),
                   .max_fragments = pass.readWrite(attributes.max_fragments),
                   .brick_mask = static_cast<std::uint32_t>(job.buffers.brickCapacity() - 1),
                   .leaf_count = leaf_count,
                   .sum_shift = attributes.sum_shift});
}

AttributeSums sumsOf(AttributeBuffers& attributes, DeviceTree& octree)
{
    return {octree.nodes,         attributes.sums,         octree.emission_words, attributes.emission_sums,
            attributes.sum_shift, &octree.voxel_attributes};
}

} // namespace

RowShape RowShape::on(const vk::Device& device)
{
    const std::uint32_t columns = tunedValue(device, Tunable::RowColumns);
    return {columns, std::max(tunedValue(device, Tunable::BandLanes), kProductMin / columns)};
}

SumForm SumForm::on(const vk::Device& device)
{
    return {.int64 = device.isEnabled(kInt64Atomics), .mixed = tunedValue(device, Tunable::MixedSums) != 0};
}

VoxelizeEstimate VoxelizeEstimate::of(const GpuScene& scene, const Grid& grid, RowShape shape)
{
    const double voxel = grid.voxel_size;
    const double area = scene.surface_area / (voxel * voxel);
    const double grid_leaves = std::pow(static_cast<double>(grid.resolution()) / 4, 3);
    VoxelizeEstimate result;
    result.leaves = std::min(area * 1.5 / 16, grid_leaves); // a plane meets about 1.5 per 16 voxels of area
    // A big triangle covers some 16 voxels or more, and has as many rows as a square of its bounding box' area.
    result.big_triangles = std::min(static_cast<double>(scene.triangle_count), area / 16);
    const double strips = result.big_triangles + std::sqrt(result.big_triangles * 2 * area) / gpu::kBlockRows;
    result.row_blocks = strips + 2 * area / (gpu::kBlockRows * shape.block_columns);
    return result;
}

VoxelizeCapacities VoxelizeCapacities::estimate(const GpuScene& scene, const Grid& grid, RowShape shape)
{
    // An inner node stands above every eight leaves or so. The table should be no more than half full.
    const VoxelizeEstimate likely = VoxelizeEstimate::of(scene, grid, shape);
    VoxelizeCapacities result;
    result.bricks = std::bit_ceil(clampedCount(likely.leaves * 1.15 * 2, kBricksMin, kBricksGuessMax));
    result.big_triangles = clampedCount(likely.big_triangles * 1.5, kBigTrianglesMin, kBigTrianglesGuessMax);
    result.row_blocks = clampedCount(likely.row_blocks * 1.5, kRowBlocksMin, kRowBlocksGuessMax);
    return result;
}

VoxelizeBuffers::VoxelizeBuffers(vk::Device& device, const VoxelizeCapacities& capacities, const GpuScene& scene,
                                 std::optional<RowShape> asked, std::optional<SumForm> asked_form)
    : counters(device, "voxelize/brick_counters", 1), shape(asked.value_or(RowShape::on(device))),
      sum_form(asked_form.value_or(SumForm::on(device)))
{
    sum_form.mixed = sum_form.mixed && asked_form;
    bricks = {device, "voxelize/bricks", brickBytes(capacities.bricks, sum_form.mixed) / sizeof(gpu::BrickEntry)};
    assert(!sum_form.int64 || device.isEnabled(kInt64Atomics));
    assert(std::has_single_bit(shape.block_columns) && shape.block_columns >= 4);
    assert(shape.block_columns <= RowShape::kBlockColumnsMax);
    assert(std::has_single_bit(shape.strip_lanes) && shape.strip_lanes <= gpu::kBandsGroup);
    assert(shape.block_columns * shape.strip_lanes >= RowShape::kProductMin);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        if (scene.chunks[i].workgroups() != 0)
        {
            rows[i].big_triangles = {device, "voxelize/big_triangles", capacities.big_triangles};
            rows[i].row_blocks = {device, "voxelize/row_blocks", capacities.row_blocks};
            rows[i].counters = {device, "voxelize/raster_counters", 1};
        }
    }
}

std::uint64_t VoxelizeBuffers::brickBytes(std::uint64_t capacity, bool mixed)
{
    return capacity * (sizeof(gpu::BrickEntry) + (mixed ? sizeof(gpu::MixedVoxels) : 0));
}

AttributeBuffers::AttributeBuffers(vk::Device& device, std::uint32_t voxel_count, std::uint32_t sum_count,
                                   bool emission)
    : sums(device, "voxelize/sums", sum_count), max_fragments(device, "voxelize/max_fragments", 1)
{
    if (emission)
    {
        partials = {device, "voxelize/partials",
                    divideUp(divideUp(voxel_count, gpu::kVoxelsPerEmissionWord), gpu::kScanBlock)};
        emissive_count = {device, "voxelize/emissive_count", 1};
    }
}

void clearCoverage(vk::FrameGraph& graph, VoxelizeBuffers& buffers)
{
    graph.fill(buffers.bricks, 0);
    graph.fill(buffers.counters, 0);
    for (VoxelizeBuffers::RowWork& rows : buffers.rows)
    {
        if (rows.counters.count() != 0)
        {
            graph.fill(rows.counters, 0);
        }
    }
}

void walkTriangles(vk::FrameGraph& graph, const RasterWalk& walk, MaterialClass material_class,
                   std::uint64_t first_group, std::uint64_t group_count)
{
    const TriangleChunks& chunks = walk.job.scene.uploaded().chunksOf(material_class);
    const std::uint64_t end = first_group + group_count;
    const std::uint64_t whole_end = std::min(end, chunks.whole.count());
    if (first_group < whole_end)
    {
        walkChunks(graph, walk, material_class, chunks.whole, first_group, whole_end - first_group, false);
    }
    if (end > chunks.whole.count())
    {
        const std::uint64_t first_single = std::max(first_group, chunks.whole.count()) - chunks.whole.count();
        const std::uint64_t first = first_single * gpu::kChunkTriangles;
        const std::uint64_t single_end =
            std::min((end - chunks.whole.count()) * gpu::kChunkTriangles, chunks.single.count());
        walkChunks(graph, walk, material_class, chunks.single, first, single_end - first, true);
    }
}

void listRows(vk::FrameGraph& graph, const RasterWalk& walk, MaterialClass material_class)
{
    if (walk.mode != RasterMode::Coverage || walk.job.scene.uploaded().chunksOf(material_class).workgroups() == 0)
    {
        return;
    }
    VoxelizeBuffers::RowWork& rows = walk.job.buffers.rowsOf(material_class);
    vk::Pass pass = graph.addPass(rasterKernel<gpu::voxelize::Bands>(walk, material_class));
    pass.dispatchIndirect(rows.counters, &gpu::RasterCounters::bands, rasterParams(pass, walk, material_class),
                          divideUp(rows.big_triangles.count() * walk.job.buffers.shape.strip_lanes, gpu::kBandsGroup));
}

void walkRows(vk::FrameGraph& graph, const RasterWalk& walk, MaterialClass material_class)
{
    if (walk.job.scene.uploaded().chunksOf(material_class).workgroups() == 0)
    {
        return;
    }
    VoxelizeBuffers::RowWork& rows = walk.job.buffers.rowsOf(material_class);
    const auto record = [&](const auto& kernel)
    {
        vk::Pass pass = graph.addPass(kernel);
        pass.dispatchIndirect(rows.counters, &gpu::RasterCounters::rows, rasterParams(pass, walk, material_class),
                              divideUp(rows.row_blocks.count() * gpu::kBlockRows, gpu::kRowsGroup));
    };
    recordRaster<gpu::voxelize::Rows, gpu::voxelize::RowsInt64>(walk, material_class, record);
}

void voxelizeCoverage(vk::FrameGraph& graph, const VoxelizeJob& job)
{
    clearCoverage(graph, job.buffers);
    walkAll(graph, {job});
}

void resolveVoxels(vk::FrameGraph& graph, const GpuScene& scene, AttributeBuffers& attributes, DeviceTree& octree)
{
    vk::Pass pass = graph.addPass(gpu::voxelize::Resolve{});
    pass.dispatch(octree.voxel_count, {.scene = readColorTables(pass, scene),
                                       .sums = pass.read(attributes.sums),
                                       .emission_words = pass.read(octree.emission_words),
                                       .attributes = pass.write(octree.voxel_attributes),
                                       .max_fragments = pass.readWrite(attributes.max_fragments),
                                       .voxel_count = octree.voxel_count,
                                       .has_emission = octree.emission_words.count() != 0 ? 1U : 0U,
                                       .sum_shift = attributes.sum_shift});
}

void voxelizeAttributes(vk::FrameGraph& graph, const VoxelizeJob& job, const vk::BufferOf<gpu::WorkItem>& leaves,
                        AttributeBuffers& attributes, DeviceTree& octree)
{
    const bool emission = octree.emission_words.count() != 0;
    assert(!emission || !job.buffers.sum_form.mixed);
    graph.fill(attributes.sums, 0);
    graph.fill(attributes.max_fragments, 0);
    if (emission)
    {
        graph.fill(octree.emission_words, 0);
    }
    const AttributeSums sums = sumsOf(attributes, octree);
    walkAll(graph, {job, RasterMode::Attributes, &sums});
    if (job.buffers.sum_form.mixed)
    {
        resolveMixed(graph, job, leaves, attributes, octree);
        return;
    }
    resolveVoxels(graph, job.scene.uploaded(), attributes, octree);
    if (emission)
    {
        rankEmissiveVoxels(graph, attributes, octree);
    }
}

void voxelizeEmission(vk::FrameGraph& graph, const VoxelizeJob& job, AttributeBuffers& attributes, DeviceTree& octree)
{
    graph.fill(attributes.emission_sums, 0);
    const AttributeSums sums = sumsOf(attributes, octree);
    walkAll(graph, {job, RasterMode::Emission, &sums});
    vk::Pass pass = graph.addPass(gpu::voxelize::ResolveEmission{});
    pass.dispatch(octree.voxel_count, {.sums = pass.read(attributes.sums),
                                       .emission_sums = pass.read(attributes.emission_sums),
                                       .emission_words = pass.read(octree.emission_words),
                                       .emission = pass.write(octree.emission),
                                       .voxel_count = octree.voxel_count,
                                       .sum_shift = attributes.sum_shift});
}

} // namespace zvo
