// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/headless/pipeline.h"
#include "core/tree/tree_data.h"
#include "io/scene/stage.h"
#include "vk/headless.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace zvo
{

/// How a StageOctree is made.
struct StageOctreeOptions
{
    Coverage coverage = TreeBuildInfo().coverage;
    bool attributes = true;
    TreeStructure structure = TreeStructure::Svo; // of what is fixed
    HistoryBounds history = {};
};

/// What the static part of a stage came to.
struct StaticPart
{
    std::uint64_t triangle_count = 0;
    std::uint32_t voxel_count = 0;
    std::uint32_t node_count = 0;
    std::uint64_t geometry_bytes = 0;             // nodes; of a DAG lists, too
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason
    std::vector<vk::PassTime> passes;             // of voxelization and construction
    std::vector<vk::PassTime> compress_passes;    // of a DAG
};

/// One update, with the attempts that had too little memory.
struct StageUpdate
{
    UpdateReport report;
    std::vector<vk::PassTime> passes; // of the attempt that succeeded
    std::uint32_t retry_count = 0;
};

/// A stage in device memory: what is fixed is voxelized once, what moves is merged with it at every time that is asked
/// for. Submits to the device's queue and waits.
class StageOctree
{
public:
    /// Uploads and builds everything but the movers' voxels. stage must outlive this. Throws Error{Memory} when the
    /// device's budget does not suffice.
    StageOctree(vk::HeadlessDevice& device, const Stage& stage, const Grid& grid, const StageOctreeOptions& options);
    StageOctree(vk::HeadlessDevice& device, Stage&& stage, const Grid& grid,
                const StageOctreeOptions& options) = delete;

    /// Merges the movers as they are at a time of the stage. Throws Error{Memory} as above.
    StageUpdate update(double seconds);

    /// What to trace: DynamicOctree::tree().
    [[nodiscard]] const DeviceTree& tree() const { return m_dynamic->tree(); }

    [[nodiscard]] DynamicOctree& dynamic() { return *m_dynamic; }
    [[nodiscard]] const StaticPart& staticPart() const { return m_static_part; }
    [[nodiscard]] std::uint64_t moverTriangleCount() const { return m_mover_triangle_count; }

private:
    DeviceTree makeStaticPart(const Grid& grid, const StageOctreeOptions& options, float emission_scale);

    vk::HeadlessDevice& m_device;
    const Stage& m_stage;
    StaticPart m_static_part;
    std::uint64_t m_mover_triangle_count = 0;
    std::unique_ptr<DynamicOctree> m_dynamic;
    std::vector<MoverId> m_movers; // in the order of the stage
};

/// The largest emission of anything in stage: the scale of everything that is voxelized into one octree.
float brightestEmission(const Stage& stage);

} // namespace zvo
