// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree/octree_builder.h"
#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// Runs all of the static half on device: voxelize, build, attributes (OctreeBuilder). Waits between its steps. Throws
/// as these.
BuildResult buildOctree(vk::HeadlessDevice& device, const PosedGpuScene& scene, const GridTile& tile,
                        const BuildOptions& options);

/// The Morton codes of all voxels, ascending: voxel_count of them.
std::vector<std::uint64_t> voxelCodes(vk::HeadlessDevice& device, const DeviceTree& octree);

} // namespace zvo
