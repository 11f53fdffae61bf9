// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "shared/tree_table.h"

namespace zvo
{

/// What shaders of a host need to know of tree (docs/host-glsl.md). Out of date once one of the tree's buffers is
/// another one, as updates of a DynamicOctree may make it. Declares no access: the host sees to it that the device is
/// done with what writes the tree.
gpu::TreeTable treeTable(const DeviceTree& tree);

} // namespace zvo
