// SPDX-License-Identifier: MIT
#pragma once

#include "core/algebra/components.h"
#include "core/algebra/tree_operator.h"
#include "core/base/step_job.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace zvo
{

/// An operation on trees as users see it.
struct AlgebraInfo
{
    TreeOperation operation = TreeOperation::Unite;
    bool corners = false;           // neighbours are all 26, else the 6 across faces
    std::uint32_t voxels = 1;       // Dilate, Erode: how many times, at least 1
    std::size_t largest = 0;        // Keep: so many components, the largest; 0: those of least_voxels or more
    std::uint64_t least_voxels = 1; // at least 1
};

/// Carries out an operation: finds components first where it needs them, and repeats dilation and erosion.
class AlgebraJob final : public StepJob
{
public:
    /// color_tables, a and b, which may be null, outlive the job. Throws as TreeOperator, and Error{Usage} if an
    /// operation has no second tree that needs one, or has one that does not.
    AlgebraJob(vk::Device& device, const GpuScene& color_tables, const AlgebraInfo& info, const DeviceTree& a,
               const DeviceTree* b);

    [[nodiscard]] bool isDone() const override { return !m_finder && !m_operator; }
    void record(vk::FrameGraph& graph) override;
    void resume(std::vector<vk::PassTime> passes) override;

    /// Hands out the result. Call it once, after the job is done.
    [[nodiscard]] DeviceTree take() { return std::move(m_result); }

private:
    void operate(const DeviceTree& a);
    void endOperation();
    void endComponents();
    [[nodiscard]] ComponentOptions componentOptions() const;

    vk::Device& m_device;
    const GpuScene& m_tables;
    AlgebraInfo m_info;
    const DeviceTree& m_a;
    const DeviceTree* m_b;
    std::optional<ComponentFinder> m_finder;
    std::optional<TreeOperator> m_operator;
    Components m_components;
    vk::BufferOf<gpu::uvec2> m_masks;
    bool m_is_masked = false;
    DeviceTree m_result; // so far
};

} // namespace zvo
