// SPDX-License-Identifier: MIT
// Algebra of octrees (shaders/algebra/algebra.h). All functions wait for the device, and throw as TreeOperator and
// ComponentFinder.
#pragma once

#include "core/algebra/components.h"
#include "core/algebra/tree_operator.h"
#include "vk/headless.h"

#include <cstddef>
#include <cstdint>

namespace zvo
{

/// The union of two octrees, their intersection, or their difference.
DeviceTree combineTrees(vk::HeadlessDevice& device, TreeOperation operation, const DeviceTree& a, const DeviceTree& b);

/// An octree after dilation or erosion by a number of voxels, one at a time.
DeviceTree spreadTree(vk::HeadlessDevice& device, TreeOperation operation, bool corners, std::uint32_t voxels,
                      DeviceTree tree);

/// The components of an octree's voxels. corners: all 26 neighbours belong together, else the 6 across faces.
Components findComponents(vk::HeadlessDevice& device, const DeviceTree& octree, bool corners);

/// An octree without the voxels of components that are not kept.
DeviceTree keepComponents(vk::HeadlessDevice& device, const DeviceTree& octree, bool corners,
                          const Components& components, const ComponentThreshold& threshold);

/// An octree with all that its voxels enclose: what no way across faces, through empty cells, leads to from outside of
/// the grid. It is a filled one.
DeviceTree encloseTree(vk::HeadlessDevice& device, const DeviceTree& octree);

} // namespace zvo
