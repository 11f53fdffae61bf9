// SPDX-License-Identifier: MIT
#pragma once

#include "core/edit/voxel_clip.h"
#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>

namespace zvo
{

/// Copies the voxels of a box of an edited tree, without dynamic objects, to the host's memory. tree: with room for
/// overlays. root: of the edited tree (DynamicOctree::editedRoot()). box: of at most VoxelClip::kCellsMax cells, within
/// the grid. Waits. Throws Error{Memory}.
VoxelClip copyVoxels(vk::HeadlessDevice& device, const DeviceTree& tree, std::uint32_t root, const VoxelBox& box);

} // namespace zvo
