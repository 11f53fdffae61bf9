// SPDX-License-Identifier: MIT
#pragma once

#include "core/svdag/svdag_builder.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

namespace zvo
{

/// Makes a DAG of an octree, or of a DAG in which equal nodes stand several times (SvdagBuilder). Waits between its
/// steps. Throws as these.
CompressResult compress(vk::HeadlessDevice& device, DeviceTree source, const CompressOptions& options = {});

/// The DAG of an octree in the host's memory, there again. What voxels look like stays there: only nodes and their
/// attributes go to the device and back. Waits. Throws as these.
TreeData compressTree(vk::HeadlessDevice& device, TreeData octree);

} // namespace zvo
