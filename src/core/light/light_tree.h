// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "light/light_tree.h"
#include "vk/frame_graph.h"

#include <cstdint>

namespace zvo
{

/// Whether a tree has voxels that give off light.
bool hasEmission(const DeviceTree& tree);

/// The light tree over the emissive voxels of a DeviceTree (shaders/light/light_tree.h).
struct LightTree
{
    /// Room for the lights that tree can have. Throws Error{Memory}.
    LightTree(vk::Device& device, const DeviceTree& tree);

    /// Whether the buffers suffice for tree.
    [[nodiscard]] bool suffices(const DeviceTree& tree) const;

    std::uint64_t node_capacity = 0;
    vk::BufferOf<gpu::LightNode> nodes;   // [node_capacity] by levels from the root on
    vk::BufferOf<gpu::LightBrick> bricks; // [brick capacity] of the lowest level
    vk::BufferOf<gpu::LightItem> items;   // [node_capacity]
    vk::BufferOf<gpu::LightLevel> levels; // [kNodeLevelsMax]
    vk::BufferOf<gpu::DispatchArgs> args; // [kNodeLevelsMax] a workgroup for each node of a level
};

/// Records the passes that make the light tree of a tree with emissive voxels. table: of tree. Needed once for each
/// DeviceTree::version. Cost: the nodes above emissive voxels.
void buildLightTree(vk::FrameGraph& graph, const DeviceTree& tree, const vk::BufferOf<gpu::TreeTable>& table,
                    LightTree& lights);

} // namespace zvo
