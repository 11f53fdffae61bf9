// SPDX-License-Identifier: MIT
#include "core/update/layer.h"

#include "core/base/clamped_count.h"
#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "core/base/with_slack.h"
#include "core/voxelize/fragment_sums.h"

#include <algorithm>
#include <bit>

namespace zvo
{

namespace
{

constexpr std::uint64_t kLayerCountMin = 64;
constexpr std::uint64_t kCountMax = 1 << 22;
constexpr std::uint64_t kVoxelsOfLeaf = 24; // of 64: a plane through a leaf sets 16

VoxelForm formOf(Coverage coverage, LayerContents contents)
{
    return {
        .coverage = coverage, .attributes = contents.attributes, .emission = contents.emission, .fill = contents.fill};
}

} // namespace

LayerCapacities LayerCapacities::estimate(const GpuScene& scene, const Grid& grid, Coverage coverage)
{
    const VoxelizeEstimate likely = VoxelizeEstimate::of(scene, grid, coverage);
    const auto count = [](double value) { return clampedCount(value * 1.25, kLayerCountMin, kCountMax); };
    LayerCapacities result;
    result.leaves = count(likely.leaves);
    result.voxels = result.leaves * kVoxelsOfLeaf;
    result.voxelize.bricks = count(likely.bricks * 1.5);
    result.voxelize.table = std::bit_ceil(2 * result.voxelize.bricks);
    result.voxelize.setups = count(likely.setups);
    result.voxelize.items = count(likely.items);
    result.voxelize.large = count(likely.large);
    return result;
}

LayerCapacities LayerCapacities::grownFor(const gpu::LayerCounters& layer) const
{
    LayerCapacities grown = *this;
    const VoxelizeCapacities needed = voxelize.grownFor(layer.bins);
    grown.voxelize.bricks = enough(voxelize.bricks, needed.bricks);
    grown.voxelize.table = std::max(needed.table, std::bit_ceil(2 * grown.voxelize.bricks));
    grown.voxelize.setups = enough(voxelize.setups, needed.setups);
    grown.voxelize.items = enough(voxelize.items, needed.items);
    grown.voxelize.large = enough(voxelize.large, needed.large);
    grown.voxelize.fill_planes = needed.fill_planes;
    grown.leaves = enough(leaves, layer.leaf_count);
    grown.voxels = enough(voxels, layer.voxel_count);
    return grown;
}

LayerBuffers::LayerBuffers(vk::Device& device, const LayerCapacities& capacities, const GpuScene& scene,
                           Coverage coverage, LayerContents contents)
    : carves(contents.carves), voxelize(device, capacities.voxelize, scene, formOf(coverage, contents)),
      counters(device, "update/layer_counters", 1), keys(device, "update/layer_keys", capacities.leaves),
      nodes(device, "update/layer_nodes", capacities.voxelize.bricks + capacities.leaves)
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

std::uint64_t LayerBuffers::bytes(const LayerCapacities& capacities, const GpuScene& scene, Coverage coverage,
                                  LayerContents contents)
{
    std::uint64_t bytes = capacities.voxelize.bytes(scene, formOf(coverage, contents)) +
                          capacities.leaves * (sizeof(gpu::uvec2) + sizeof(gpu::Node)) +
                          capacities.voxelize.bricks * sizeof(gpu::Node);
    bytes += contents.attributes ? capacities.voxels * sizeof(gpu::VoxelSums) : 0;
    bytes += contents.emission ? capacities.voxels * sizeof(gpu::EmissionSums) +
                                     divideUp(capacities.voxels, gpu::kVoxelsPerEmissionWord) * sizeof(gpu::uvec2)
                               : 0;
    return bytes;
}

Grid LayerBuffers::gridFor(const Grid& grid) const
{
    constexpr std::uint32_t kDepthMin = 3; // of grids that are filled
    Grid result = grid;
    result.depth = carves ? std::clamp(grid.depth + 1, kDepthMin, Grid::kDepthMax) : grid.depth;
    return result;
}

std::uint32_t LayerBuffers::kind(const Grid& grid) const
{
    const Grid own = gridFor(grid);
    return (carves ? gpu::kLayerCarves : 0) | (own.nodeLevels() != grid.nodeLevels() ? gpu::kLayerDeeper : 0) |
           (hasWideKeys(own) ? gpu::kLayerWideKeys : 0);
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

// Lists the nodes above bricks that are inside as a whole.
void listInside(vk::FrameGraph& graph, const LayerJob& job)
{
    LayerBuffers& layer = job.layer;
    VoxelizeBuffers& voxelize = layer.voxelize;
    const Grid grid = layer.gridFor(job.grid);
    const auto brick_mask = static_cast<std::uint32_t>(voxelize.table.count() - 1);
    {
        vk::Pass pass = graph.addPass(gpu::update::LayerParents{.wide_keys = hasWideKeys(grid)});
        pass.dispatchIndirect(voxelize.counters, &gpu::BinCounters::collect,
                              {.bricks = pass.readWrite(voxelize.table),
                               .ranges = pass.read(voxelize.ranges),
                               .bins = pass.readWrite(voxelize.counters),
                               .window = windowOf(grid),
                               .brick_mask = brick_mask},
                              divideUp(voxelize.ranges.count(), gpu::kBricksGroup));
    }
    vk::Pass pass = graph.addPass(gpu::update::LayerNodes{.wide_keys = hasWideKeys(grid)});
    pass.dispatch(voxelize.table.count(), {.bricks = pass.readWrite(voxelize.table),
                                           .bins = pass.read(voxelize.counters),
                                           .keys = pass.write(layer.keys),
                                           .nodes = pass.write(layer.nodes),
                                           .counters = pass.readWrite(layer.counters),
                                           .window = windowOf(grid),
                                           .brick_mask = brick_mask,
                                           .brick_capacity = static_cast<std::uint32_t>(layer.firstLeaf()),
                                           .leaf_capacity = static_cast<std::uint32_t>(layer.leafCapacity())});
}

// Lists the leaves, and checks whether there was room for everything.
void listLeaves(vk::FrameGraph& graph, const LayerJob& job)
{
    LayerBuffers& layer = job.layer;
    VoxelizeBuffers& voxelize = layer.voxelize;
    graph.fill(layer.counters, 0);
    if (voxelize.fill_planes != 0)
    {
        listInside(graph, job);
    }
    const Grid grid = layer.gridFor(job.grid);
    const std::uint32_t lanes = tunedValue(graph.device(), Tunable::BrickLanes);
    vk::Pass pass = graph.addPass(gpu::update::LayerLeaves{.wide_keys = hasWideKeys(grid),
                                                           .brick_lanes = lanes,
                                                           .carves = layer.carves,
                                                           .fill_words = voxelize.fillWords()});
    gpu::LayerLeavesParams params{};
    params.bricks = pass.readWrite(voxelize.table);
    params.ranges = pass.read(voxelize.ranges);
    params.masks = pass.read(voxelize.masks);
    params.crossings = pass.read(voxelize.crossings);
    params.bins = pass.readWrite(voxelize.counters);
    params.keys = pass.write(layer.keys);
    params.nodes = pass.write(layer.nodes);
    params.counters = pass.readWrite(layer.counters);
    params.reports = pass.readWrite(job.reports);
    params.window = windowOf(grid);
    params.brick_capacity = static_cast<std::uint32_t>(layer.firstLeaf());
    params.leaf_capacity = static_cast<std::uint32_t>(layer.leafCapacity());
    // Where no sums are kept, nothing limits their number.
    params.voxel_capacity = layer.sums.count() != 0 ? static_cast<std::uint32_t>(layer.sums.count()) : UINT32_MAX;
    params.report = job.report;
    pass.dispatchIndirect(voxelize.counters, &gpu::BinCounters::leaves, params,
                          divideUp(voxelize.ranges.count() * lanes, gpu::kBricksGroup));
}

VoxelizeJob voxelizeJob(const LayerJob& job)
{
    return {job.scene, job.layer.gridFor(job.grid), job.layer.voxelize};
}

// Adds the stages that put the triangles into bricks, for each material class in pieces.
void addBins(const LayerJob& job, UpdateStages& stages)
{
    for (const MaterialClass material_class : kMaterialClasses)
    {
        const std::uint64_t group_count = job.scene.uploaded().chunksOf(material_class).workgroups();
        if (group_count != 0)
        {
            stages.push_back({"bin triangles", group_count, true,
                              [job, material_class](vk::FrameGraph& graph, std::uint64_t first, std::uint64_t count)
                              { binTriangles(graph, voxelizeJob(job), material_class, first, count); }});
        }
    }
}

// Adds the stage that adds up what fragments have, in pieces of workgroups, of which the last ones may have no items.
void addSums(const LayerJob& job, const char* name, RasterMode mode, UpdateStages& stages)
{
    const std::uint64_t group_count = divideUp(job.layer.voxelize.items.count(), gpu::kItemsGroup);
    stages.push_back({name, group_count, true,
                      [job, mode](vk::FrameGraph& graph, std::uint64_t first, std::uint64_t count)
                      {
                          LayerBuffers& layer = job.layer;
                          const FragmentTarget sums = {layer.nodes,
                                                       static_cast<std::uint32_t>(layer.firstLeaf()),
                                                       layer.sums,
                                                       layer.emission_words,
                                                       layer.emission_sums,
                                                       job.sum_shift,
                                                       SumForm::on(graph.device()).int64};
                          addFragments(graph, voxelizeJob(job), mode, sums, first * gpu::kItemsGroup,
                                       count * gpu::kItemsGroup);
                      }});
}

} // namespace

void addLayerStages(const LayerJob& job, UpdateStages& stages)
{
    const auto add = [&](const char* name, std::uint64_t units, const auto& record)
    { stages.push_back(wholeStage(name, units, record)); };
    const VoxelizeBuffers& voxelize = job.layer.voxelize;
    add("clear a layer", voxelize.table.count(),
        [job](vk::FrameGraph& graph) { clearVoxels(graph, job.layer.voxelize); });
    addBins(job, stages);
    add("cover voxels", voxelize.items.count(), [job](vk::FrameGraph& graph) { coverBricks(graph, voxelizeJob(job)); });
    if (voxelize.fill_planes != 0)
    {
        add("fill", voxelize.ranges.count(), [job](vk::FrameGraph& graph) { fillBricks(graph, voxelizeJob(job)); });
    }
    add("list leaves", voxelize.ranges.count(), [job](vk::FrameGraph& graph) { listLeaves(graph, job); });
    if (job.layer.sums.count() == 0)
    {
        return;
    }
    add("clear sums", job.layer.sums.count(), [job](vk::FrameGraph& graph) { clearSums(graph, job.layer); });
    addSums(job, "add colours and normals", RasterMode::Attributes, stages);
    if (job.layer.emission_words.count() != 0)
    {
        addSums(job, "add emission", RasterMode::Emission, stages);
    }
}

} // namespace zvo
