// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

namespace zvo
{

/// Copies what rays see of tree, merged and edited or not, into an octree of its own: everything below the first node
/// of an octree or a DAG, breadth first. The result is equal to downloadTree() of an octree built from these voxels.
/// Attributes have 8 bytes. Waits. Throws Error{Usage} for a tree with attributes in another format, Error{Memory} for
/// 2^32 nodes or voxels and more. Cost: nodes and voxels, on the host.
TreeData flattenTree(vk::HeadlessDevice& device, const DeviceTree& tree);

} // namespace zvo
