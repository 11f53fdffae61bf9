// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"
#include "vk/headless.h"

namespace zvo
{

/// Copies an octree, or a DAG, to the host and waits. An octree must have levels, and its nodes must stand as they were
/// built: not the enlarged one of a dynamic update. Throws Error{Usage} for one that does not.
TreeData downloadTree(vk::HeadlessDevice& device, const Octree& octree);
TreeData downloadTree(vk::HeadlessDevice& device, const Svdag& dag);

} // namespace zvo
