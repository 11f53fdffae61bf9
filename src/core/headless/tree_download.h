// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"
#include "vk/headless.h"

namespace zvo
{

/// Copies a tree to the host and waits. Its nodes must stand level by level as they were built, without room for
/// overlays; of a DAG as few words of lists as it takes. Throws Error{Usage} for a tree that does not.
TreeData downloadTree(vk::HeadlessDevice& device, const DeviceTree& tree);

} // namespace zvo
