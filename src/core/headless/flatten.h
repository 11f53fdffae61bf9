// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

namespace zvo
{

/// What rays see of tree as an octree of its own: everything below its first node, merged and edited or not, an octree
/// or a DAG, breadth first as if it had been built so. Equal to downloadTree() of an octree that was just built. Waits.
/// Attributes have 8 bytes. Throws Error{Usage} for a tree with attributes in another format, Error{Memory} for 2^32
/// nodes or voxels and more. Cost: nodes and voxels, on the host.
TreeData flattenTree(vk::HeadlessDevice& device, const DeviceTree& tree);

} // namespace zvo
