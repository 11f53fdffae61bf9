// SPDX-License-Identifier: MIT
// DAGs that the oracle makes, in device memory.
#pragma once

#include "core/tree/device_tree.h"
#include "oracle/dag.h"
#include "vk/headless.h"

namespace zvo::test
{

/// Compresses the octree's nodes by the oracle. octree must have its levels.
oracle::ReferenceDag referenceDagOf(vk::HeadlessDevice& device, const DeviceTree& octree);

/// The DAG of octree, with copies of its attributes; those of nodes are in depth-first order.
DeviceTree svdagOf(vk::HeadlessDevice& device, const DeviceTree& octree, std::uint32_t entries_per_word = 0);
DeviceTree svdagOf(vk::HeadlessDevice& device, const DeviceTree& octree, const oracle::ReferenceDag& reference,
                   std::uint32_t entries_per_word);

/// The voxels and nodes of dag, and the faults in them.
oracle::DagContents dagContentsOf(vk::HeadlessDevice& device, const DeviceTree& dag);

} // namespace zvo::test
