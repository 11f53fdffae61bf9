// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/step_job.h"
#include "core/octree/brick_octree.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/fragment_sums.h"
#include "core/voxelize/voxelize.h"
#include "vk/timer.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

/// Options of a build.
struct BuildOptions
{
    Coverage coverage = TreeBuildInfo().coverage;
    bool attributes = true;
    std::optional<VoxelizeCapacities> capacities = std::nullopt; // of the first run; by default, an estimate
    bool keep_sums = false; // keeps the sums of attributes in DeviceTree::sums: 32 bytes a voxel
    /// By default, what suits the device, with sums of mixed voxels alone only where triangles are large enough. Where
    /// sums are kept, or something emits light, all voxels have sums in any case.
    std::optional<SumForm> sum_form = std::nullopt;
    Fill fill = Fill::None;
    Shell shell = Shell::Surface;
};

/// GPU time of those passes that belong to an operation, "voxelize" or "octree": its kernels and the fills of its
/// buffers.
double operationMs(std::span<const vk::PassTime> passes, std::string_view operation);

/// How open the surfaces are that were filled.
struct OpenSurfaces
{
    std::uint32_t lines = 0; // through voxels' centres, that are inside behind all triangles: vertical ones, of
                             // Fill::Robust along each axis
    std::optional<std::uint64_t> undecided; // of Fill::Robust: voxels left out that as much speaks for as against
};

/// An octree and how it came about.
struct BuildResult
{
    DeviceTree octree;
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason; only reasons that occurred
    OpenSurfaces open;
    std::vector<vk::PassTime> passes; // of the runs that succeeded
    VoxelizeCapacities capacities;    // those that sufficed
    std::uint32_t retry_count = 0;    // runs that were thrown away because something was too small

    /// operationMs() of the passes.
    [[nodiscard]] double operationMs(std::string_view operation) const { return zvo::operationMs(passes, operation); }
};

/// Makes an octree of a scene. Between steps the builder reads sizes and allocates exactly what is needed. When
/// something was too small it grows, and the step is repeated. resume() throws Error{Memory} when 32-bit numbers or the
/// device's budget do not suffice.
///
/// For a GridTile that is a part of the grid, the result is an octree of the whole grid with the voxels in that tile.
/// These voxels and their attributes are a slice, in Morton order, of those of the whole grid, as long as no voxel has
/// more than 65,535 fragments. BuildResult::dropped is that of the whole grid. A scene without triangles in the grid
/// gives an octree without nodes. Only whole grids of depth 3 or more are filled.
class OctreeBuilder final : public BuildJob<OctreeBuilder, BuildResult>
{
public:
    /// scene must outlive the builder. Throws Error{Usage} for a depth outside 1 to Grid::kDepthMax, for a tile outside
    /// of the grid, and for attributes if the scene was uploaded without them.
    OctreeBuilder(vk::Device& device, const PosedGpuScene& scene, const GridTile& tile, const BuildOptions& options);

private:
    // Where the values of the last step stand in the readback.
    struct ReadbackOffsets
    {
        BrickCountOffsets counts;
        std::uint64_t max_fragments = 0;
        std::uint64_t emissive_count = 0;
    };

    VoxelizeJob voxelizeJob();
    void cover(vk::FrameGraph& graph);
    void learnCoverage();
    void grow(const VoxelizeCapacities& grown);
    void number(vk::FrameGraph& graph);
    void endNumbers();
    void attributes(vk::FrameGraph& graph);
    void learnAttributes();
    void emission(vk::FrameGraph& graph);
    void endVoxelAttributes();
    void average(vk::FrameGraph& graph);
    void leafWords(vk::FrameGraph& graph);
    void end();

    vk::Device& m_device;
    PosedGpuScene m_scene;
    GridTile m_tile;
    BuildOptions m_options;
    bool m_int64 = false; // SumForm::int64
    VoxelForm m_form;
    std::optional<OctreeBricks> m_bricks;
    std::optional<AttributeBuffers> m_sums;
    std::uint32_t m_item_count = 0;  // of all bricks
    std::uint32_t m_mixed_count = 0; // mixed voxels, where they alone have sums
    std::uint32_t m_emissive_count = 0;
    vk::BufferOf<gpu::uvec2> m_occupied; // masks of the leaves of a filled tree
    vk::BufferOf<gpu::Node> m_pool;      // takes the place of the nodes in the end
    ReadbackOffsets m_offsets;
};

} // namespace zvo
