// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree/octree_build.h"
#include "core/tree/octree.h"
#include "core/upload/gpu_scene.h"
#include "core/voxelize/voxelize.h"
#include "vk/readback.h"
#include "vk/timer.h"
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
    Coverage coverage = Coverage::Thin;
    bool attributes = true;
    std::optional<VoxelizeCapacities> capacities = std::nullopt; // where to start; by default, an estimate
    bool keep_sums = false; // of attributes, for BuildResult::sums: 28 bytes a voxel
};

/// GPU time of those passes that belong to an operation, "voxelize" or "octree": its kernels, and the fills of its
/// buffers.
double operationMs(std::span<const vk::PassTime> passes, std::string_view operation);

/// An octree and how it came about.
struct BuildResult
{
    Octree octree;
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason; only reasons that occurred
    std::vector<vk::PassTime> passes;             // of the runs that succeeded
    VoxelizeCapacities capacities;                // that sufficed
    std::uint32_t retry_count = 0;                // runs that were thrown away because something was too small
    FragmentSums sums;                            // with BuildOptions::keep_sums

    /// operationMs() of the passes.
    [[nodiscard]] double stageMs(std::string_view operation) const { return operationMs(passes, operation); }
};

/// Makes an octree of a scene in steps, each of them recorded into a frame and never waited for:
///
///     while (!builder.isDone())
///     {
///         builder.record(graph);       // submit
///         builder.stepDone(passes);    // once the device is done
///     }
///
/// Between steps, sizes are learnt and exactly what is needed is allocated; what turned out too small grows, and the
/// step comes again. Of a tile (GridTile), an octree of the whole grid with what lies in it: its voxels and their
/// attributes are a slice, in Morton order, of what the whole grid gives, as long as no voxel has more than 65,535
/// fragments. dropped is that of the whole grid. A scene without triangles in the grid gives an octree without nodes.
class OctreeBuilder
{
public:
    /// scene outlives it. Throws Error{Usage} for a depth outside 1 to Grid::kDepthMax, a tile that is not there and
    /// attributes that the scene was not uploaded with.
    OctreeBuilder(vk::Device& device, const PlacedScene& scene, const GridTile& tile, const BuildOptions& options);
    OctreeBuilder(const OctreeBuilder&) = delete;
    OctreeBuilder& operator=(const OctreeBuilder&) = delete;

    [[nodiscard]] bool isDone() const { return m_step == Step::Done; }

    /// Records the next step. The device must be done with the one before, unless that never reached it: then this is
    /// the same one again. Throws Error{Memory} when the device's budget does not suffice, and what making a kernel
    /// throws; what was recorded may reach the device all the same, and the step can be recorded again.
    void record(vk::FrameGraph& graph);

    /// The device is done with the step that was recorded last; passes: its times, if they were taken. Throws
    /// Error{Memory} where 32-bit numbers do not suffice, or the device's budget; then nothing comes of it.
    void stepDone(std::vector<vk::PassTime> passes = {});

    /// What came of it, once.
    [[nodiscard]] BuildResult take() { return std::move(m_result); }

    /// What a run showed to be too small.
    struct Growth
    {
        VoxelizeCapacities needed; // what is known to be: maybe still too little
        VoxelizeCapacities likely; // what will suffice, as far as the run tells
    };

private:
    enum class Step
    {
        Cover,
        Number,
        Attributes,
        Emission,
        Average,
        Done
    };
    // The brick table with its node list.
    struct Coverings
    {
        VoxelizeBuffers voxelize;
        OctreeBuildBuffers work;
    };
    // In the readback.
    struct Places
    {
        std::uint64_t counters = 0;
        std::uint64_t ranges = 0;
        std::vector<std::uint64_t> rasters; // of the material classes that there are
        std::uint64_t max_fragments = 0;
        std::uint64_t emissive_count = 0;
    };

    void cover(vk::FrameGraph& graph);
    bool learnCoverage();
    void grow(const Growth& growth);
    void allocateNodes(const gpu::BrickCounters& counters);
    void attributes(vk::FrameGraph& graph);
    bool learnAttributes();
    void emission(vk::FrameGraph& graph);
    void endVoxelAttributes();
    void average(vk::FrameGraph& graph);

    vk::Device& m_device;
    PlacedScene m_scene;
    GridTile m_tile;
    BuildOptions m_options;
    BuildResult m_result;
    Step m_step = Step::Cover;
    std::optional<Coverings> m_coverings;
    std::optional<AttributeBuffers> m_sums;
    std::uint32_t m_emissive_count = 0;
    vk::Readback m_readback;
    Places m_places;
};

} // namespace zvo
