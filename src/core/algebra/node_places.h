// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/frame_graph.h"

#include <cstddef>

namespace zvo
{

/// Records the passes that write where the nodes of an octree stand (shaders/algebra/place.glsl), for the first
/// level_count levels: places has an element for each of their nodes. The octree has leaf words, or its nodes have
/// plain numbers, as while it is made. Cost: nodes.
void placeNodes(vk::FrameGraph& graph, const DeviceTree& octree, std::size_t level_count,
                vk::BufferOf<gpu::uvec2>& places);

/// Nodes of the first levels.
std::uint32_t nodesOf(const DeviceTree& octree, std::size_t level_count);

/// Throws Error{Usage} if a tree is not an octree with leaf words and no room for overlays, or none at all.
void requireOperand(const DeviceTree& tree);

} // namespace zvo
