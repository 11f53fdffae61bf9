// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree/octree_builder.h"
#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// Makes the octree of a scene: coverage, numbering and attributes, in the steps of OctreeBuilder. Waits after each
/// step. Throws as OctreeBuilder.
BuildResult buildOctree(vk::HeadlessDevice& device, const PosedGpuScene& scene, const GridTile& tile,
                        const BuildOptions& options);

/// The Morton codes of all voxels, ascending: [voxel_count].
std::vector<std::uint64_t> voxelCodes(vk::HeadlessDevice& device, const DeviceTree& octree);

} // namespace zvo
