// SPDX-License-Identifier: MIT
#include "core/update/layer.h"

#include "core/base/divide_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace zvo
{

namespace
{

constexpr std::uint64_t kLayerBricksMin = 256;
constexpr std::uint64_t kRowsMin = 256; // bands, and row blocks

} // namespace

LayerCapacities LayerCapacities::estimate(const GpuScene& scene, const Grid& grid, RowShape shape)
{
    // The table has no inner nodes, and should be no more than half full.
    const VoxelizeEstimate likely = VoxelizeEstimate::of(scene, grid, shape);
    const auto clamped = [](double value, double low, double high)
    { return static_cast<std::uint64_t>(std::clamp(value, low, high)); };
    LayerCapacities result;
    result.leaves = clamped(likely.leaves * 1.25, 64, 1 << 22);
    result.voxels = result.leaves * 24; // of 64 in a leaf: a plane through it sets 16
    result.voxelize.bricks = std::bit_ceil(std::max(2 * result.leaves, kLayerBricksMin));
    result.voxelize.big_triangles = clamped(likely.big_triangles * 1.5, kRowsMin, 1 << 20);
    result.voxelize.row_blocks = clamped(likely.row_blocks * 1.5, kRowsMin, 1 << 23);
    return result;
}

LayerBuffers::LayerBuffers(vk::Device& device, const LayerCapacities& capacities, const GpuScene& scene,
                           LayerContents contents)
    : voxelize(device, capacities.voxelize, scene), counters(device, "update/layer_counters", 1),
      keys(device, "update/layer_keys", capacities.leaves), leaves(device, "update/layer_leaves", capacities.leaves)
{
    if (contents.attributes)
    {
        sums = {device, "update/layer_sums", capacities.voxels};
    }
    if (contents.emission)
    {
        emission_words = {device, "update/layer_emission_words",
                          divideUp(capacities.voxels, gpu::kVoxelsPerEmissionWord)};
        emission_sums = {device, "update/layer_emission_sums", gpu::kVoxelsPerEmissionWord * emission_words.count()};
    }
}

std::uint64_t LayerBuffers::bytes(const LayerCapacities& capacities, const GpuScene& scene, LayerContents contents)
{
    std::uint64_t bytes = capacities.voxelize.bricks * sizeof(gpu::BrickEntry) +
                          capacities.leaves * (sizeof(gpu::uvec2) + sizeof(gpu::Node));
    for (const TriangleChunks& chunks : scene.chunks)
    {
        bytes += chunks.workgroups() == 0 ? 0
                                          : capacities.voxelize.big_triangles * sizeof(gpu::BigTriangle) +
                                                capacities.voxelize.row_blocks * sizeof(gpu::RowBlock);
    }
    bytes += contents.attributes ? capacities.voxels * sizeof(gpu::VoxelSums) : 0;
    bytes += contents.emission ? capacities.voxels * sizeof(gpu::EmissionSums) +
                                     divideUp(capacities.voxels, gpu::kVoxelsPerEmissionWord) * sizeof(gpu::uvec2)
                               : 0;
    return bytes;
}

namespace
{

void clearSums(vk::FrameGraph& graph, LayerBuffers& layer)
{
    graph.fill(layer.sums, 0);
    if (layer.emission_words.count() != 0)
    {
        graph.fill(layer.emission_sums, 0);
        vk::Pass pass = graph.addPass(gpu::update::EmissionPlaces{});
        const gpu::EmissionPlacesParams params = {pass.write(layer.emission_words), 0,
                                                  static_cast<std::uint32_t>(layer.emission_words.count()), 0};
        pass.dispatch(layer.emission_words.count(), params);
    }
}

// Lists the leaves, and checks whether there was room for everything.
void listLeaves(vk::FrameGraph& graph, const LayerJob& job)
{
    LayerBuffers& layer = job.layer;
    VoxelizeBuffers& voxelize = layer.voxelize;
    graph.fill(layer.counters, 0);
    vk::Pass pass = graph.addPass(gpu::update::LayerLeaves{.wide_keys = hasWideKeys(job.grid)});
    gpu::LayerLeavesParams params{};
    params.bricks = pass.readWrite(voxelize.bricks);
    params.keys = pass.write(layer.keys);
    params.leaves = pass.write(layer.leaves);
    params.counters = pass.readWrite(layer.counters);
    params.reports = pass.readWrite(job.reports);
    params.brick_capacity = static_cast<std::uint32_t>(voxelize.brickCapacity());
    params.leaf_capacity = static_cast<std::uint32_t>(layer.leaves.count());
    // Where no sums are kept, nothing limits their number.
    params.voxel_capacity = layer.sums.count() != 0 ? static_cast<std::uint32_t>(layer.sums.count()) : UINT32_MAX;
    params.report = job.report;
    for (std::uint32_t i = 0; i < gpu::kClassCount; ++i)
    {
        const VoxelizeBuffers::RowWork& rows = voxelize.rows[i];
        params.rasters[i] = pass.read(rows.counters);
        params.big_capacity = std::max(params.big_capacity, static_cast<std::uint32_t>(rows.big_triangles.count()));
        params.block_capacity = std::max(params.block_capacity, static_cast<std::uint32_t>(rows.row_blocks.count()));
    }
    pass.dispatch(divideUp(voxelize.brickCapacity(), gpu::kCollectItems), params);
}

// Adds a walk over the triangles: for each material class, the chunks of small ones in pieces, then the big ones.
void addWalk(const LayerJob& job, const char* name, RasterMode mode, UpdateStages& stages)
{
    for (const MaterialClass material_class : kMaterialClasses)
    {
        const std::uint64_t group_count = job.scene.uploaded().chunksOf(material_class).workgroups();
        if (group_count == 0)
        {
            continue;
        }
        const auto withWalk = [job, mode](const auto& record)
        {
            LayerBuffers& layer = job.layer;
            const AttributeSums sums = {layer.leaves, layer.sums, layer.emission_words, layer.emission_sums,
                                        job.sum_shift};
            record(RasterWalk{{job.scene, job.grid, job.coverage, layer.voxelize}, mode, &sums});
        };
        stages.push_back(
            {name, group_count, true, [=](vk::FrameGraph& graph, std::uint64_t first, std::uint64_t count) {
                 withWalk([&](const RasterWalk& walk) { walkTriangles(graph, walk, material_class, first, count); });
             }});
        stages.push_back(wholeStage(fmt::format("{}, large triangles", name), group_count,
                                    [=](vk::FrameGraph& graph)
                                    {
                                        withWalk(
                                            [&](const RasterWalk& walk)
                                            {
                                                listRows(graph, walk, material_class);
                                                walkRows(graph, walk, material_class);
                                            });
                                    }));
    }
}

} // namespace

void addLayerStages(const LayerJob& job, UpdateStages& stages)
{
    const auto add = [&](const char* name, std::uint64_t units, const auto& record)
    { stages.push_back(wholeStage(name, units, record)); };
    const std::uint64_t capacity = job.layer.voxelize.brickCapacity();
    add("clear a layer", capacity, [job](vk::FrameGraph& graph) { clearCoverage(graph, job.layer.voxelize); });
    addWalk(job, "cover voxels", RasterMode::Coverage, stages);
    add("list leaves", capacity, [job](vk::FrameGraph& graph) { listLeaves(graph, job); });
    if (job.layer.sums.count() == 0)
    {
        return;
    }
    add("clear sums", job.layer.sums.count(), [job](vk::FrameGraph& graph) { clearSums(graph, job.layer); });
    addWalk(job, "add colours and normals", RasterMode::Attributes, stages);
    if (job.layer.emission_words.count() != 0)
    {
        addWalk(job, "add emission", RasterMode::Emission, stages);
    }
}

} // namespace zvo
