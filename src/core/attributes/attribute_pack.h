// SPDX-License-Identifier: MIT
// Attributes in fewer bytes (docs/attributes.md).
#pragma once

#include "core/base/step_job.h"
#include "core/tree/device_tree.h"
#include "vk/device.h"
#include "vk/frame_graph.h"

#include <utility>
#include <vector>

namespace zvo
{

/// Records the passes that pack attributes into words, [packedWords(format, attributes.count())]. The words follow from
/// the attributes alone. Cost: attributes.
void packAttributes(vk::FrameGraph& graph, const vk::BufferOf<gpu::Attribute>& attributes, AttributeFormat format,
                    vk::BufferOf<gpu::uint>& words);

/// Replaces the attributes of a tree, those of voxels and of nodes, by such in a packed format, in one step. Done from
/// the start for a tree without attributes of 8 bytes, and for another format.
class TreePacker final : public StepJob
{
public:
    /// tree: an octree, or what a DAG has of one. It must outlive the steps.
    TreePacker(vk::Device& device, AttributeFormat format, DeviceTree& tree);

    [[nodiscard]] bool isDone() const override { return m_is_done; }
    void record(vk::FrameGraph& graph) override;
    void resume(std::vector<vk::PassTime> passes) override;

    /// The passes, once.
    [[nodiscard]] std::vector<vk::PassTime> take() { return std::move(m_passes); }

private:
    vk::Device& m_device;
    AttributeFormat m_format;
    DeviceTree& m_tree;
    PackedAttributes m_packed;
    std::vector<vk::PassTime> m_passes;
    bool m_is_done;
};

} // namespace zvo
