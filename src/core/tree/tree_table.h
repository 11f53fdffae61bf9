// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "shared/tree_table.h"

namespace zvo
{

/// What shaders of a host need to know of tree (docs/host-glsl.md). Out of date as soon as one of the tree's buffers is
/// replaced, which updates of a DynamicOctree may do. Declares no access: the host has to make sure that the device is
/// done with whatever writes the tree.
gpu::TreeTable treeTable(const DeviceTree& tree);

} // namespace zvo
