// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/update/update_budget.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/voxelize.h"
#include "update/update.h"
#include "vk/frame_graph.h"
#include "zvo/types.h"

#include <cstdint>

namespace zvo
{

/// The capacities of a layer's buffers.
struct LayerCapacities
{
    VoxelizeCapacities voxelize;
    std::uint64_t leaves = 0;
    std::uint64_t voxels = 0;

    /// A guess from the mesh's surface area and the grid; it suffices in most cases.
    static LayerCapacities estimate(const GpuScene& scene, const Grid& grid, Coverage coverage);

    /// At least those that a layer needs, as its counters tell: counts past a capacity are exact unless the table was
    /// full.
    [[nodiscard]] LayerCapacities grownFor(const gpu::LayerCounters& layer) const;

    bool operator==(const LayerCapacities&) const = default;
};

/// What a layer is: what it holds besides the positions of its voxels, and what it does with them.
struct LayerContents
{
    bool attributes = true;
    bool emission = false;  // only with attributes
    bool carves = false;    // it takes its voxels from the base tree; without attributes
    Fill fill = Fill::None; // the voxels inside of the mesh are its own as well; only if it carves, not Robust
};

/// The voxels of one dynamic object; shaders/update/update.h describes layers.
struct LayerBuffers
{
    LayerBuffers(vk::Device& device, const LayerCapacities& capacities, const GpuScene& scene, Coverage coverage,
                 LayerContents contents);

    /// Bytes of device memory that such buffers take.
    static std::uint64_t bytes(const LayerCapacities& capacities, const GpuScene& scene, Coverage coverage,
                               LayerContents contents);

    /// Where the leaves stand in nodes.
    [[nodiscard]] std::uint64_t firstLeaf() const { return voxelize.ranges.count(); }

    /// [capacities.leaves]
    [[nodiscard]] std::uint64_t leafCapacity() const { return keys.count(); }

    /// The grid in which the mesh is voxelized, for a tree with this grid. Triangles above count for what is inside: a
    /// layer that carves sees those up to a grid's height above the grid, except at Grid::kDepthMax.
    [[nodiscard]] Grid gridFor(const Grid& grid) const;

    /// gpu::Layer::kind for a tree with this grid.
    [[nodiscard]] std::uint32_t kind(const Grid& grid) const;

    bool carves;
    VoxelizeBuffers voxelize;
    vk::BufferOf<gpu::LayerCounters> counters;     // [1]
    vk::BufferOf<gpu::uvec2> keys;                 // [capacities.leaves]
    vk::BufferOf<gpu::Node> nodes;                 // [capacities.voxelize.bricks] of bricks, then [capacities.leaves]
    vk::BufferOf<gpu::VoxelSums> sums;             // [capacities.voxels], or empty without attributes
    vk::BufferOf<gpu::uvec2> emission_words;       // [ceil(capacities.voxels / 32)], or empty without emission
    vk::BufferOf<gpu::EmissionSums> emission_sums; // [capacities.voxels], or empty without emission
};

/// A dynamic object and the layer into which it is voxelized.
struct LayerJob
{
    PosedGpuScene scene;
    const Grid& grid;
    std::uint32_t sum_shift = 0;
    LayerBuffers& layer;
    vk::BufferOf<gpu::LayerCounters>& reports; // host-visible
    std::uint32_t report = 0;                  // element of reports that becomes a copy of the layer's counters
};

/// Adds the stages that voxelize a dynamic object into a layer: first coverage, then the sums of its fragments'
/// attributes. Nothing is read back; what does not fit is counted, and the layer is marked as failed. Everything that
/// job refers to must outlive the stages. Cost: triangles plus fragments, and the layer's capacities once, for clearing
/// them.
void addLayerStages(const LayerJob& job, UpdateStages& stages);

} // namespace zvo
