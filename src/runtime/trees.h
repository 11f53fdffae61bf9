// SPDX-License-Identifier: MIT
// Trees that the device makes and changes, and copies of them on the host. All functions wait for the device.
#pragma once

#include "core/octree/octree_builder.h"
#include "core/svdag/svdag_builder.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// Makes the octree of a scene: coverage, numbering and attributes. Throws as OctreeBuilder.
BuildResult buildOctree(vk::HeadlessDevice& device, const PosedGpuScene& scene, const GridTile& tile,
                        const BuildOptions& options);

/// Makes a DAG of an octree, or of a DAG in which equal nodes occur several times. Throws as SvdagBuilder.
CompressResult compress(vk::HeadlessDevice& device, DeviceTree source, const CompressOptions& options = {});

/// Makes a DAG of an octree in the host's memory. Only nodes and their attributes are copied to the device and back;
/// the attributes of voxels stay on the host. Throws as SvdagBuilder.
TreeData compressTree(vk::HeadlessDevice& device, TreeData octree);

/// Replaces the attributes of tree by the same in a packed format (docs/attributes.md). Returns the times of the
/// passes. Throws Error{Memory} when the device's budget does not suffice.
std::vector<vk::PassTime> packTree(vk::HeadlessDevice& device, AttributeFormat format, DeviceTree& tree);

/// Copies a tree to the host. The nodes must stand level by level as they were built, without room for overlays, and
/// the lists of a DAG must be packed as tightly as possible. Throws Error{Usage} for any other tree.
TreeData downloadTree(vk::HeadlessDevice& device, const DeviceTree& tree);

/// The Morton codes of an octree's voxels, ascending: [voxel_count].
std::vector<std::uint64_t> voxelCodes(vk::HeadlessDevice& device, const DeviceTree& octree);

} // namespace zvo
