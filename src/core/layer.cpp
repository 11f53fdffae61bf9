// SPDX-License-Identifier: MIT
#include "core/layer.h"

#include "core/divide_up.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace zvo
{

namespace
{

constexpr std::uint64_t kBricksMin = 256;
constexpr std::uint64_t kRowsMin = 256; // bands, and row blocks

} // namespace

LayerCapacities LayerCapacities::estimate(const GpuScene& scene, const Grid& grid)
{
    // As VoxelizeCapacities::estimate, without inner nodes and with a voxel and a half for each unit of area.
    const double voxel = grid.voxel_size;
    const double area = scene.surface_area / (voxel * voxel);
    const double grid_leaves = std::pow(static_cast<double>(grid.resolution()) / 4, 3);
    const double leaves = std::clamp(std::min(area * 1.5 / 16, grid_leaves) * 1.25, 64.0, double{1 << 22});
    const double big = std::min(static_cast<double>(scene.triangle_count), area / 16);
    const double strips = big + std::sqrt(big * 2 * area) / gpu::kBlockRows;
    const double blocks = strips + 2 * area / (gpu::kBlockRows * gpu::kBlockColumns);
    LayerCapacities result;
    result.leaves = static_cast<std::uint64_t>(leaves);
    result.voxels = result.leaves * 24; // of 64 in a leaf: a plane through it sets 16
    result.voxelize.bricks = std::bit_ceil(std::max(2 * result.leaves, kBricksMin));
    result.voxelize.big_triangles =
        static_cast<std::uint64_t>(std::clamp(big * 1.5, double{kRowsMin}, double{1 << 20}));
    result.voxelize.row_blocks =
        static_cast<std::uint64_t>(std::clamp(blocks * 1.5, double{kRowsMin}, double{1 << 23}));
    return result;
}

LayerBuffers::LayerBuffers(vk::Device& device, const LayerCapacities& capacities, const GpuScene& scene,
                           LayerContents contents)
    : voxelize(device, capacities.voxelize, scene), counters(device, "update/layer_counters", 1),
      triangle_args(device, "update/layer_args", gpu::kClassCount),
      keys(device, "update/layer_keys", capacities.leaves), leaves(device, "update/layer_leaves", capacities.leaves)
{
    if (contents.attributes)
    {
        sums = {device, "update/layer_sums", capacities.voxels};
    }
    if (contents.emission)
    {
        emission_words = {device, "update/layer_emission_words", divideUp(capacities.voxels, 32)};
        emission_sums = {device, "update/layer_emission_sums", capacities.voxels};
    }
}

std::uint64_t LayerBuffers::bytes(const LayerCapacities& capacities, const GpuScene& scene, LayerContents contents)
{
    std::uint64_t bytes = capacities.voxelize.bricks * sizeof(gpu::BrickEntry) +
                          capacities.leaves * (sizeof(gpu::uvec2) + sizeof(gpu::Node));
    for (const vk::BufferOf<gpu::Chunk>& chunks : scene.chunks)
    {
        bytes += chunks.count() == 0 ? 0
                                     : capacities.voxelize.big_triangles * sizeof(gpu::BigTriangle) +
                                           capacities.voxelize.row_blocks * sizeof(gpu::RowBlock);
    }
    bytes += contents.attributes ? capacities.voxels * sizeof(gpu::VoxelSums) : 0;
    bytes += contents.emission
                 ? capacities.voxels * sizeof(gpu::EmissionSums) + divideUp(capacities.voxels, 32) * sizeof(gpu::uvec2)
                 : 0;
    return bytes;
}

namespace
{

// Lists the leaves and decides whether everything had room.
void listLeaves(vk::FrameGraph& graph, const GpuScene& scene, const Grid& grid, LayerBuffers& layer,
                vk::BufferOf<gpu::LayerCounters>& reports, std::uint32_t report)
{
    VoxelizeBuffers& voxelize = layer.voxelize;
    graph.fill(layer.counters, 0);
    {
        vk::Pass pass = graph.addPass("update/layer_leaves", {hasWideKeys(grid) ? 1U : 0U});
        gpu::LayerLeavesParams params{};
        params.bricks = pass.readWrite(voxelize.bricks);
        params.keys = pass.write(layer.keys);
        params.leaves = pass.write(layer.leaves);
        params.counters = pass.readWrite(layer.counters);
        params.brick_capacity = static_cast<std::uint32_t>(voxelize.bricks.count());
        params.leaf_capacity = static_cast<std::uint32_t>(layer.leaves.count());
        pass.dispatch(divideUp(voxelize.bricks.count(), gpu::kCollectItems), params);
    }
    vk::Pass pass = graph.addPass("update/layer_check");
    gpu::LayerCheckParams params{};
    params.counters = pass.readWrite(layer.counters);
    params.reports = pass.readWrite(reports);
    params.report = report;
    params.brick_counters = pass.read(voxelize.counters);
    params.triangles = pass.write(layer.triangle_args);
    params.leaf_capacity = static_cast<std::uint32_t>(layer.leaves.count());
    params.voxel_capacity =
        layer.sums.count() != 0 ? static_cast<std::uint32_t>(layer.sums.count()) : UINT32_MAX; // none are kept
    params.max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    for (std::uint32_t i = 0; i < gpu::kClassCount; ++i)
    {
        VoxelizeBuffers::RowWork& rows = voxelize.rows[i];
        params.rasters[i] = pass.read(rows.counters);
        params.rows[i] = pass.readWrite(rows.args);
        params.chunk_counts[i] = static_cast<std::uint32_t>(scene.chunks[i].count());
        params.big_capacity = std::max(params.big_capacity, static_cast<std::uint32_t>(rows.big_triangles.count()));
        params.block_capacity = std::max(params.block_capacity, static_cast<std::uint32_t>(rows.row_blocks.count()));
    }
    pass.dispatch(1, params);
}

} // namespace

void voxelizeLayer(vk::FrameGraph& graph, const PlacedScene& scene, const Grid& grid, Coverage coverage,
                   std::uint32_t sum_shift, LayerBuffers& layer, vk::BufferOf<gpu::LayerCounters>& reports,
                   std::uint32_t report)
{
    voxelizeCoverage(graph, scene, grid, coverage, layer.voxelize);
    listLeaves(graph, scene.uploaded(), grid, layer, reports, report);
    if (layer.sums.count() == 0)
    {
        return;
    }
    const AttributeSums sums = {layer.leaves,        layer.sums, layer.emission_words,
                                layer.emission_sums, sum_shift,  &layer.triangle_args};
    graph.fill(layer.sums, 0);
    if (layer.emission_words.count() != 0)
    {
        vk::Pass pass = graph.addPass("update/emission_places");
        const gpu::EmissionPlacesParams params = {pass.write(layer.emission_words), 0,
                                                  static_cast<std::uint32_t>(layer.emission_words.count()), 0};
        pass.dispatch(layer.emission_words.count(), params);
    }
    addAttributes(graph, scene, grid, coverage, layer.voxelize, sums);
    if (layer.emission_words.count() != 0)
    {
        graph.fill(layer.emission_sums, 0);
        addEmission(graph, scene, grid, coverage, layer.voxelize, sums);
    }
}

} // namespace zvo
