// SPDX-License-Identifier: MIT
#pragma once

#include "core/svdag/svdag_builder.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

namespace zvo
{

/// Makes a DAG of an octree, or of a DAG in which equal nodes occur several times (SvdagBuilder), and waits after each
/// step. Throws as SvdagBuilder.
CompressResult compress(vk::HeadlessDevice& device, DeviceTree source, const CompressOptions& options = {});

/// The same for an octree in the host's memory. Only nodes and their attributes are copied to the device and back; the
/// attributes of voxels stay on the host. Waits. Throws as SvdagBuilder.
TreeData compressTree(vk::HeadlessDevice& device, TreeData octree);

} // namespace zvo
