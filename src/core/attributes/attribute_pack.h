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

/// Records the passes that pack `attributes` into `words`, [packedWords(format, attributes.count())]. Equal attributes
/// give equal words. Cost: proportional to the number of attributes.
void packAttributes(vk::FrameGraph& graph, const vk::BufferOf<gpu::Attribute>& attributes, AttributeFormat format,
                    vk::BufferOf<gpu::uint>& words);

/// A job of one step that replaces the attributes of a tree, of voxels and of nodes, by the same attributes in a packed
/// format. The job is done from the start where there is nothing to pack: when `format` is not a packed one, or when
/// the tree has no attributes of 8 bytes.
class TreePacker final : public StepJob
{
public:
    /// tree: an octree, or a DAG (only attributes are touched). It must outlive the job.
    TreePacker(vk::Device& device, AttributeFormat format, DeviceTree& tree);

    [[nodiscard]] bool isDone() const override { return m_is_done; }
    void record(vk::FrameGraph& graph) override;
    void resume(std::vector<vk::PassTime> passes) override;

    /// Hands out the times of the job's passes. Call it once, after the job is done.
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
