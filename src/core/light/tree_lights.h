// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/light_tree.h"
#include "core/tree/device_tree.h"
#include "shared/tree_table.h"
#include "vk/deletion_queue.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <memory>

namespace zvo
{

/// What kernels need to find the light of a tree's emissive voxels: a table of its buffers, and the light tree. Both
/// are made anew when the tree's version (DeviceTree::version) is not the one for which they were made.
class TreeLights
{
public:
    /// deletion_queue: as in TreeTracer.
    explicit TreeLights(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr)
        : m_device(device), m_deletion_queue(deletion_queue), m_table(device, "light/tree", 1)
    {
    }

    /// Records the passes that are needed before kernels use the lights of tree, if any. Throws Error{Memory}.
    void prepare(vk::FrameGraph& graph, const DeviceTree& tree);

    /// Has everything made anew next time: because the last frame was lost, or kernels may have changed.
    void forget() { m_version = 0; }

    /// Declares that pass reads the lights of tree, for which they were prepared, and sets their addresses in params.
    /// Does nothing for a tree without emissive voxels.
    template <typename Params> void read(vk::AnyPass& pass, const DeviceTree& tree, Params& params) const
    {
        if (!hasEmission(tree))
        {
            return;
        }
        params.tree = pass.read(m_table);
        pass.read(tree.emission_words);
        pass.read(tree.emission);
        params.light_nodes = pass.read(m_lights->nodes);
        params.light_bricks = pass.read(m_lights->bricks);
    }

    /// [1] where the buffers of the tree are.
    [[nodiscard]] const vk::BufferOf<gpu::TreeTable>& table() const { return m_table; }

    /// Nodes of the light tree, of a tree with emissive voxels.
    [[nodiscard]] const vk::BufferOf<gpu::LightNode>& nodes() const { return m_lights->nodes; }

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    vk::BufferOf<gpu::TreeTable> m_table;
    std::unique_ptr<LightTree> m_lights; // null until a tree has emissive voxels
    std::uint64_t m_version = 0;         // of the tree for which all was made; 0: none
};

} // namespace zvo
