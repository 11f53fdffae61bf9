// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "shared/tree_table.h"
#include "vk/frame_graph.h"

namespace zvo
{

/// What shaders of a host need to know of tree (docs/host-glsl.md). Out of date as soon as one of the tree's buffers is
/// replaced, which updates of a DynamicOctree may do. Declares no access: the host has to make sure that the device is
/// done with whatever writes the tree.
gpu::TreeTable treeTable(const DeviceTree& tree);

/// Declares that pass reads what the table of tree names, but for the attributes of voxels, and returns where the table
/// is.
gpu::ConstPtr<gpu::TreeTable> readTree(vk::AnyPass& pass, const DeviceTree& tree,
                                       const vk::BufferOf<gpu::TreeTable>& table);

} // namespace zvo
