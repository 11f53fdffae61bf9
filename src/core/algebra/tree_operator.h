// SPDX-License-Identifier: MIT
#pragma once

#include "algebra/algebra.h"
#include "core/base/step_job.h"
#include "core/octree/brick_octree.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "vk/timer.h"
#include "zvo/enums.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace zvo
{

/// An operation and its operands, which outlive the job.
struct OperationInfo
{
    TreeOperation operation = TreeOperation::Unite;
    bool corners = false; // neighbours are all 26, else the 6 across faces
    const DeviceTree* a = nullptr;
    const DeviceTree* b = nullptr;                   // of Unite, Intersect and Subtract
    const vk::BufferOf<gpu::uvec2>* masks = nullptr; // [nodes of a] of Keep and Enclose (core/algebra/components.h)
};

/// The octree that an operation has made.
struct OperationResult
{
    DeviceTree octree;
    std::vector<vk::PassTime> passes;
    std::uint32_t retry_count = 0;
};

/// Carries out an operation by listed bricks, and makes an octree of the result. That is filled if either operand of
/// Unite, both of Intersect, or a of the other operations is; that of Enclose always is. Voxels keep the attributes and
/// the emission that they have in a, or else in b. New ones have the mean of their neighbours' in a, or look like what
/// is inside of a, and none emits; voxels that Erode or Subtract lays bare get a normal away from what they touch. The
/// result depends on the operands alone. Cost: bricks with voxels, and those beside them.
class TreeOperator final : public BuildJob<TreeOperator, OperationResult>
{
public:
    /// color_tables: uploadColorTables() or a scene; it outlives the job. Throws Error{Usage} for trees that are not
    /// octrees, of different grids, of which one alone has attributes, or whose emission has different scales.
    TreeOperator(vk::Device& device, const GpuScene& color_tables, const OperationInfo& info);

private:
    void list(vk::FrameGraph& graph);
    void learnBricks();
    void number(vk::FrameGraph& graph);
    void endNumbers();
    void looks(vk::FrameGraph& graph);
    void learnEmission();
    void emission(vk::FrameGraph& graph);
    void beginAverages();
    void average(vk::FrameGraph& graph);
    void end();

    [[nodiscard]] bool hasTwo() const { return m_info.b != nullptr; }
    [[nodiscard]] const DeviceTree& second() const { return hasTwo() ? *m_info.b : *m_info.a; }
    gpu::Operand readOperand(vk::AnyPass& pass, const DeviceTree& tree);
    void listBricksOf(vk::FrameGraph& graph, const DeviceTree& tree, vk::BufferOf<gpu::uvec2>& places);
    template <typename Kernel> void cells(vk::FrameGraph& graph);
    void listFull(vk::FrameGraph& graph);
    void lookPass(vk::FrameGraph& graph, bool emission);
    [[nodiscard]] std::uint32_t bricksAlong() const;
    [[nodiscard]] std::uint32_t leavesAlong() const;

    vk::Device& m_device;
    const GpuScene& m_tables;
    OperationInfo m_info;
    bool m_filled = false;
    bool m_attributes = false;
    bool m_emits = false;
    VoxelizeCapacities m_capacities;
    std::optional<OctreeBricks> m_bricks;
    vk::BufferOf<gpu::uint> m_full;
    vk::BufferOf<gpu::Node> m_no_nodes; // in place of the nodes of an empty operand
    vk::BufferOf<gpu::uvec2> m_places;  // of a, then of the result
    vk::BufferOf<gpu::uvec2> m_other_places;
    vk::BufferOf<gpu::Looks> m_looks; // [2]
    vk::BufferOf<gpu::uint> m_partials;
    vk::BufferOf<gpu::uint> m_emissive_count; // [1]
    vk::BufferOf<gpu::uvec2> m_occupied;
    vk::BufferOf<gpu::Node> m_pool;
    BrickCountOffsets m_counts;
    std::uint64_t m_emissive_offset = 0;
};

} // namespace zvo
