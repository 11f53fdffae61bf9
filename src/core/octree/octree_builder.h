// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/step_job.h"
#include "core/octree/octree_build.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
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

/// What is made of a scene.
struct BuildOptions
{
    Coverage coverage = TreeBuildInfo().coverage;
    bool attributes = true;
    std::optional<VoxelizeCapacities> capacities = std::nullopt; // where to start; by default, an estimate
    bool keep_sums = false;                                      // of attributes, in DeviceTree::sums: 28 bytes a voxel
};

/// GPU time of those passes that belong to an operation, "voxelize" or "octree": its kernels, and the fills of its
/// buffers.
double operationMs(std::span<const vk::PassTime> passes, std::string_view operation);

/// An octree and how it came about.
struct BuildResult
{
    DeviceTree octree;
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason; only reasons that occurred
    std::vector<vk::PassTime> passes;             // of the runs that succeeded
    VoxelizeCapacities capacities;                // that sufficed
    std::uint32_t retry_count = 0;                // runs that were thrown away because something was too small

    /// operationMs() of the passes.
    [[nodiscard]] double stageMs(std::string_view operation) const { return operationMs(passes, operation); }
};

/// Makes an octree of a scene. Between steps, sizes are learnt and exactly what is needed is allocated; what turned out
/// too small grows, and the step comes again: resume() throws Error{Memory} where 32-bit numbers do not suffice, or the
/// device's budget. Of a tile (GridTile), an octree of the whole grid with what lies in it: its voxels and their
/// attributes are a slice, in Morton order, of what the whole grid gives, as long as no voxel has more than 65,535
/// fragments. dropped is that of the whole grid. A scene without triangles in the grid gives an octree without nodes.
class OctreeBuilder final : public BuildJob<OctreeBuilder, BuildResult>
{
public:
    /// scene outlives it. Throws Error{Usage} for a depth outside 1 to Grid::kDepthMax, a tile that is not there and
    /// attributes that the scene was not uploaded with.
    OctreeBuilder(vk::Device& device, const PosedGpuScene& scene, const GridTile& tile, const BuildOptions& options);

    /// What a run showed to be too small.
    struct Growth
    {
        VoxelizeCapacities needed; // what is known to be: maybe still too little
        VoxelizeCapacities likely; // what will suffice, as far as the run tells
    };

private:
    // The brick table with its node list.
    struct Coverings
    {
        VoxelizeBuffers voxelize;
        OctreeBuildBuffers work;
    };
    // In the readback.
    struct ReadbackOffsets
    {
        std::uint64_t counters = 0;
        std::uint64_t ranges = 0;
        std::vector<std::uint64_t> rasters; // of the material classes that there are
        std::uint64_t max_fragments = 0;
        std::uint64_t emissive_count = 0;
    };

    void cover(vk::FrameGraph& graph);
    void learnCoverage();
    void grow(const Growth& growth);
    void allocateNodes(const gpu::BrickCounters& counters);
    void number(vk::FrameGraph& graph);
    void endNumbers();
    void attributes(vk::FrameGraph& graph);
    void learnAttributes();
    void emission(vk::FrameGraph& graph);
    void endVoxelAttributes();
    void average(vk::FrameGraph& graph);
    void end();

    vk::Device& m_device;
    PosedGpuScene m_scene;
    GridTile m_tile;
    BuildOptions m_options;
    std::optional<Coverings> m_coverings;
    std::optional<AttributeBuffers> m_sums;
    std::uint32_t m_emissive_count = 0;
    ReadbackOffsets m_offsets;
};

} // namespace zvo
