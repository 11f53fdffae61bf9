// SPDX-License-Identifier: MIT
// DAGs in device memory that the oracle has made.
#pragma once

#include "core/tree/device_tree.h"
#include "oracle/dag.h"
#include "vk/headless.h"

namespace zvo::test
{

/// The octree's nodes, compressed by the oracle. octree must have its levels.
oracle::ReferenceDag referenceDagOf(vk::HeadlessDevice& device, const DeviceTree& octree,
                                    std::uint32_t entries_per_word = 0);

/// The DAG of octree, with copies of its attributes, those of nodes in depth-first order.
DeviceTree svdagOf(vk::HeadlessDevice& device, const DeviceTree& octree, std::uint32_t entries_per_word = 0);
DeviceTree svdagOf(vk::HeadlessDevice& device, const DeviceTree& octree, const oracle::ReferenceDag& reference);

/// Voxels and nodes of dag and what is wrong with it.
oracle::DagContents dagContentsOf(vk::HeadlessDevice& device, const DeviceTree& dag);

} // namespace zvo::test
