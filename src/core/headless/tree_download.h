// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"
#include "vk/headless.h"

namespace zvo
{

/// Copies a tree to the host and waits. The nodes must stand level by level as they were built, without room for
/// overlays, and the lists of a DAG must be packed as tightly as possible. Throws Error{Usage} for any other tree.
TreeData downloadTree(vk::HeadlessDevice& device, const DeviceTree& tree);

} // namespace zvo
