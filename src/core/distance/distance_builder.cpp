// SPDX-License-Identifier: MIT
#include "core/distance/distance_builder.h"

#include "core/base/clamped_count.h"
#include "core/base/divide_up.h"
#include "core/base/morton.h"
#include "core/base/tuning.h"
#include "core/tree/tree_limits.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint64_t kReadbackBytes = 1024; // counters
constexpr std::uint32_t kRetriesMax = 32;
constexpr std::uint32_t kDepthMin = 3;
constexpr std::uint32_t kLatticeDepthMin = 6; // the grid and a margin on both sides
constexpr std::uint64_t kLeavesMax = kIndicesMax / gpu::kCentersInBand;
constexpr std::uint64_t kListedMin = 256;
constexpr std::uint64_t kListedGuessMax = 1 << 20;

// A voxelization of the whole lattice, for its items and what is inside.
constexpr VoxelForm formOf(Fill fill)
{
    return {.coverage = Coverage::Conservative, .attributes = false, .fill = fill};
}

// Entries for the bricks that the band reaches stand beside those of bricks with triangles, and of their columns.
VoxelizeCapacities withBand(VoxelizeCapacities capacities)
{
    capacities.table = std::bit_ceil(std::clamp<std::uint64_t>(4 * capacities.table, 1, VoxelizeCapacities::kTableMax));
    return capacities;
}

std::uint32_t count32(const auto& buffer)
{
    return static_cast<std::uint32_t>(buffer.count());
}

} // namespace

DistanceBuilder::DistanceBuilder(vk::Device& device, const PosedGpuScene& scene, const Grid& grid,
                                 const DistanceOptions& options)
    : m_device(device),
      m_scene(scene), m_lattice{grid.origin, grid.voxel_size, std::max(grid.depth + 1, kLatticeDepthMin)},
      m_options(options)
{
    if (grid.depth < kDepthMin || grid.depth >= Grid::kDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("distances in a grid of depth {} are out of range: {} to {} "
                                                  "(resolution {} to {})",
                                                  grid.depth, kDepthMin, Grid::kDepthMax - 1, 1U << kDepthMin,
                                                  1U << (Grid::kDepthMax - 1)));
    }
    if (options.band < 1 || options.band > gpu::kBandMax)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("a band of {} voxels is out of range: 1 to {}", options.band, gpu::kBandMax));
    }
    if (options.fill == Fill::Robust)
    {
        throw Error(ErrorCode::Usage, "distances take their sign from what fill solid or parity has inside");
    }
    m_step = {&DistanceBuilder::cover, &DistanceBuilder::learnCover};
    m_readback = {device, kReadbackBytes};
    m_result.distances.grid = grid;
    m_result.distances.band = options.band;
    const VoxelizeEstimate likely = VoxelizeEstimate::of(scene.uploaded(), m_lattice, Coverage::Conservative);
    m_listed_capacity = clampedCount(4 * likely.bricks, kListedMin, kListedGuessMax);
    m_result.capacities = options.capacities.value_or(
        withBand(VoxelizeCapacities::estimate(scene.uploaded(), m_lattice, Coverage::Conservative)));
}

void DistanceBuilder::cover(vk::FrameGraph& graph)
{
    if (!m_buffers)
    {
        const VoxelForm form = formOf(m_options.fill);
        const VoxelizeCapacities& capacities = m_result.capacities;
        m_device.memory().require(
            capacities.bytes(m_scene.uploaded(), form) + m_listed_capacity * sizeof(gpu::BandBrick), "voxelization");
        m_buffers.emplace(Buffers{.voxelize = {m_device, capacities, m_scene.uploaded(), form},
                                  .listed = {m_device, "distance/bricks", m_listed_capacity},
                                  .counters = {m_device, "distance/counters", 1}});
    }
    VoxelizeBuffers& voxelize = m_buffers->voxelize;
    const glm::ivec3 offset = glm::ivec3(gpu::kBandMarginLattice) + glm::ivec3(0, gpu::kVoxelLattice / 2, 0);
    voxelizeCoverage(graph, {.scene = m_scene, .tile = m_lattice, .buffers = voxelize, .lattice_offset = offset});
    graph.fill(m_buffers->counters, 0);
    {
        vk::Pass pass = graph.addPass(gpu::distance::MarkBand{.wide_keys = hasWideKeys(m_lattice)});
        pass.dispatchIndirect(voxelize.counters, &gpu::BinCounters::cover,
                              {.setups = pass.read(voxelize.setups),
                               .items = pass.read(voxelize.items),
                               .voxels = pass.read(voxelize.voxels),
                               .bricks = pass.readWrite(voxelize.table),
                               .counters = pass.read(voxelize.counters),
                               .band_counters = pass.readWrite(m_buffers->counters),
                               .window = windowOf(m_lattice),
                               .brick_mask = count32(voxelize.table) - 1,
                               .resolution = m_result.distances.grid.resolution(),
                               .band = m_options.band},
                              divideUp(voxelize.items.count(), gpu::kItemsGroup));
    }
    vk::Pass pass = graph.addPass(gpu::distance::ListBand{.wide_keys = hasWideKeys(m_lattice)});
    pass.dispatch(voxelize.table.count(), {.bricks = pass.read(voxelize.table),
                                           .listed = pass.write(m_buffers->listed),
                                           .counters = pass.readWrite(m_buffers->counters),
                                           .window = windowOf(m_lattice),
                                           .brick_mask = count32(voxelize.table) - 1,
                                           .listed_capacity = count32(m_buffers->listed)});
    m_bins = m_readback.copy(graph, voxelize.counters, 0, 1);
    m_counters = m_readback.copy(graph, m_buffers->counters, 0, 1);
}

// Repeats the step with larger buffers if something had no room.
void DistanceBuilder::learnCover()
{
    gpu::BinCounters bins = m_readback.at<gpu::BinCounters>(m_bins, 1).front();
    const gpu::BandCounters band = m_readback.at<gpu::BandCounters>(m_counters, 1).front();
    bins.overflow_count += band.overflow_count;
    const VoxelizeCapacities grown = m_result.capacities.grownFor(bins);
    if (grown != m_result.capacities || band.brick_count > m_listed_capacity)
    {
        m_buffers.reset();
        if (++m_result.retry_count >= kRetriesMax)
        {
            throw Error(ErrorCode::Memory,
                        fmt::format("voxelization found no room in {} attempts; lower the resolution", kRetriesMax));
        }
        m_result.capacities = grown;
        m_listed_capacity = std::max<std::uint64_t>(m_listed_capacity, band.brick_count);
        return;
    }
    if (band.leaf_count > kLeavesMax)
    {
        throwUncountable("distances");
    }
    m_result.dropped = droppedTriangles(bins);
    m_result.open_lines = bins.open_lines;
    m_item_count = bins.item_count;
    m_brick_count = band.brick_count;
    m_leaf_count = band.leaf_count;
    if (m_leaf_count == 0)
    {
        end();
        return;
    }
    m_readback = {m_device, m_brick_count * sizeof(gpu::BandBrick) + sizeof(std::uint64_t)};
    m_step = {&DistanceBuilder::list, &DistanceBuilder::order};
}

void DistanceBuilder::list(vk::FrameGraph& graph)
{
    m_counters = m_readback.copy(graph, m_buffers->listed, 0, m_brick_count);
}

// Puts the bricks in Morton order and numbers their leaves.
void DistanceBuilder::order()
{
    const std::span<const gpu::BandBrick> listed = m_readback.at<gpu::BandBrick>(m_counters, m_brick_count);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> places(m_brick_count);
    for (std::uint32_t i = 0; i < m_brick_count; ++i)
    {
        places[i] = {codeOfCell(listed[i].brick), i};
    }
    std::ranges::sort(places);
    m_buffers->ordered = {m_device, "distance/ordered", m_brick_count, vk::MemoryKind::Upload};
    std::uint32_t first_leaf = 0;
    for (std::uint32_t i = 0; i < m_brick_count; ++i)
    {
        gpu::BandBrick brick = listed[places[i].second];
        brick.first_leaf = first_leaf;
        first_leaf += static_cast<std::uint32_t>(std::popcount(brick.mask_lo) + std::popcount(brick.mask_hi));
        m_buffers->ordered.mappedData()[i] = brick;
    }
    m_readback = {m_device, m_leaf_count * sizeof(gpu::BandLeaf) + sizeof(std::uint64_t)};
    m_step = {&DistanceBuilder::measure, &DistanceBuilder::learnLeaves};
}

void DistanceBuilder::measure(vk::FrameGraph& graph)
{
    Buffers& buffers = *m_buffers;
    const std::uint64_t word_count = std::uint64_t{m_leaf_count} * gpu::kCentersInBand;
    if (buffers.squared.count() == 0)
    {
        m_device.memory().require(m_leaf_count * sizeof(gpu::BandLeaf) + 2 * word_count * sizeof(gpu::uint),
                                  "the distances");
        buffers.leaves = {m_device, "distance/leaves", m_leaf_count};
        buffers.bounds = {m_device, "distance/bounds", word_count};
        buffers.squared = {m_device, "distance/squared", word_count};
    }
    VoxelizeBuffers& voxelize = buffers.voxelize;
    graph.copy(buffers.ordered, 0, buffers.listed, 0, m_brick_count * sizeof(gpu::BandBrick));
    graph.fill(buffers.bounds,
               std::bit_cast<std::uint32_t>(static_cast<float>(gpu::kVoxelLattice * m_options.band) + 1));
    graph.fill(buffers.squared, gpu::kNoDistance);
    {
        vk::Pass pass = graph.addPass(gpu::distance::PlaceBand{});
        pass.dispatch(m_brick_count, {.bricks = pass.readWrite(voxelize.table),
                                      .listed = pass.read(buffers.listed),
                                      .leaves = pass.write(buffers.leaves),
                                      .listed_count = m_brick_count});
    }
    measurePass(graph, false);
    measurePass(graph, true);
    vk::Pass pass = graph.addPass(gpu::distance::SignBand{.wide_keys = hasWideKeys(m_lattice),
                                                          .fill_planes = std::max(voxelize.fill_planes, 1U)});
    pass.dispatch(m_leaf_count, {.bricks = pass.read(voxelize.table),
                                 .crossings = pass.read(voxelize.crossings),
                                 .squared = pass.read(buffers.squared),
                                 .leaves = pass.readWrite(buffers.leaves),
                                 .window = windowOf(m_lattice),
                                 .brick_mask = count32(voxelize.table) - 1,
                                 .leaf_count = m_leaf_count,
                                 .is_filled = m_options.fill == Fill::None ? 0U : 1U});
    m_counters = m_readback.copy(graph, buffers.leaves, 0, m_leaf_count);
}

void DistanceBuilder::measurePass(vk::FrameGraph& graph, bool exact)
{
    VoxelizeBuffers& voxelize = m_buffers->voxelize;
    const std::uint32_t lanes = tunedValue(m_device, Tunable::BandLanes);
    vk::Pass pass =
        graph.addPass(gpu::distance::Measure{.wide_keys = hasWideKeys(m_lattice), .lanes = lanes, .exact = exact});
    pass.dispatch(std::uint64_t{m_item_count} * lanes, {.setups = pass.read(voxelize.setups),
                                                        .items = pass.read(voxelize.items),
                                                        .voxels = pass.read(voxelize.voxels),
                                                        .bricks = pass.read(voxelize.table),
                                                        .listed = pass.read(m_buffers->listed),
                                                        .bounds = pass.readWrite(m_buffers->bounds),
                                                        .squared = pass.readWrite(m_buffers->squared),
                                                        .window = windowOf(m_lattice),
                                                        .brick_mask = count32(voxelize.table) - 1,
                                                        .item_count = m_item_count,
                                                        .resolution = m_result.distances.grid.resolution(),
                                                        .band = m_options.band});
}

// Finds the leaves that have a cell in the band.
void DistanceBuilder::learnLeaves()
{
    const std::span<const gpu::BandLeaf> leaves = m_readback.at<gpu::BandLeaf>(m_counters, m_leaf_count);
    std::vector<gpu::uint> kept;
    for (std::uint32_t i = 0; i < m_leaf_count; ++i)
    {
        if (leaves[i].in_band != 0)
        {
            kept.push_back(i);
        }
    }
    DeviceDistances& distances = m_result.distances;
    distances.leaf_count = static_cast<std::uint32_t>(kept.size());
    m_buffers->bounds = {};
    if (kept.size() == m_leaf_count || kept.empty())
    {
        distances.leaves = kept.empty() ? decltype(distances.leaves)() : std::move(m_buffers->leaves);
        distances.squared = kept.empty() ? decltype(distances.squared)() : std::move(m_buffers->squared);
        end();
        return;
    }
    m_buffers->kept = {m_device, "distance/kept", kept.size(), vk::MemoryKind::Upload};
    std::ranges::copy(kept, m_buffers->kept.mappedData());
    m_step = {&DistanceBuilder::keep, &DistanceBuilder::end};
}

void DistanceBuilder::keep(vk::FrameGraph& graph)
{
    DeviceDistances& distances = m_result.distances;
    if (distances.squared.count() == 0)
    {
        distances.leaves = {m_device, "distance/kept_leaves", distances.leaf_count};
        distances.squared = {m_device, "distance/kept_squared",
                             std::uint64_t{distances.leaf_count} * gpu::kCentersInBand};
    }
    vk::Pass pass = graph.addPass(gpu::distance::KeepLeaves{});
    pass.dispatch(distances.squared.count(), {.kept = pass.read(m_buffers->kept),
                                              .all_leaves = pass.read(m_buffers->leaves),
                                              .all_squared = pass.read(m_buffers->squared),
                                              .leaves = pass.write(distances.leaves),
                                              .squared = pass.write(distances.squared),
                                              .leaf_count = distances.leaf_count});
}

void DistanceBuilder::end()
{
    m_buffers.reset();
    finish();
}

} // namespace zvo
