// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/step_job.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/voxelize.h"
#include "distance/distance.h"
#include "vk/timer.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// Squared distances of cells' centres to the triangles of a scene in device memory, as a grid of leaves
/// (docs/voxelization.md, Distance). A leaf is 4^3 cells; listed are those with a cell in the band.
struct DeviceDistances
{
    Grid grid;
    std::uint32_t band = 0; // voxels: cells whose centres are farther away are beyond the band
    std::uint32_t leaf_count = 0;
    vk::BufferOf<gpu::BandLeaf> leaves; // [leaf_count] in Morton order
    /// [64 leaf_count] in Morton order, in squared lattice units times 1 << gpu::kDistanceBits; gpu::kNoDistance beyond
    /// the band.
    vk::BufferOf<gpu::uint> squared;
};

/// Options of a DistanceBuilder.
struct DistanceOptions
{
    static constexpr std::uint32_t kBandMax = gpu::kBandMax;

    std::uint32_t band = 3;  // voxels: 1 to kBandMax
    Fill fill = Fill::Solid; // what is inside: Solid or Parity; None: nothing, distances have no sign
    std::optional<VoxelizeCapacities> capacities = std::nullopt; // of the first run; by default, an estimate. The
                                                                 // table is a power of two
};

/// Distances and how they came about.
struct DistanceResult
{
    DeviceDistances distances;
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason; only reasons that occurred
    std::uint32_t open_lines = 0;     // vertical lines that are inside below all triangles: the scene is open
    std::vector<vk::PassTime> passes; // of the runs that succeeded
    VoxelizeCapacities capacities;    // those that sufficed
    std::uint32_t retry_count = 0;    // runs that were thrown away because something was too small
};

/// Finds the distances of a scene. Between steps the builder reads sizes and puts the band's bricks in order. When
/// something was too small it grows, and the step is repeated. resume() throws Error{Memory} when 32-bit numbers or the
/// device's budget do not suffice.
class DistanceBuilder final : public BuildJob<DistanceBuilder, DistanceResult>
{
public:
    /// scene must outlive the builder, and have been uploaded without TextureOptions::grid. Throws Error{Usage} for a
    /// depth outside of 3 to Grid::kDepthMax - 1 and for a band outside of 1 to gpu::kBandMax.
    DistanceBuilder(vk::Device& device, const PosedGpuScene& scene, const Grid& grid, const DistanceOptions& options);

private:
    struct Buffers
    {
        VoxelizeBuffers voxelize;
        vk::BufferOf<gpu::BandBrick> listed;
        vk::BufferOf<gpu::BandCounters> counters;
        vk::BufferOf<gpu::BandBrick> ordered = {}; // mapped
        vk::BufferOf<gpu::BandLeaf> leaves = {};   // all that the band may reach
        vk::BufferOf<gpu::uint> bounds = {};       // 64 each
        vk::BufferOf<gpu::uint> squared = {};      // 64 each
        vk::BufferOf<gpu::uint> kept = {};         // mapped: numbers of the leaves with cells in the band
    };

    void cover(vk::FrameGraph& graph);
    void learnCover();
    void list(vk::FrameGraph& graph);
    void order();
    void measure(vk::FrameGraph& graph);
    void measurePass(vk::FrameGraph& graph, bool exact);
    void learnLeaves();
    void keep(vk::FrameGraph& graph);
    void end();

    vk::Device& m_device;
    PosedGpuScene m_scene;
    Grid m_lattice; // of the voxelization, around the grid
    DistanceOptions m_options;
    std::uint64_t m_listed_capacity = 0;
    std::optional<Buffers> m_buffers;
    std::uint32_t m_item_count = 0;
    std::uint32_t m_brick_count = 0;
    std::uint32_t m_leaf_count = 0;
    std::uint64_t m_bins = 0; // offsets in the readback
    std::uint64_t m_counters = 0;
};

} // namespace zvo
