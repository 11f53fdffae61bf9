// SPDX-License-Identifier: MIT
// Octrees with the memory layout of a dynamic update.
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo::test
{

struct RelocateOptions
{
    std::uint32_t gap = 0;              // nodes, and at least as many voxels, between the old and the new ones
    std::uint32_t level_gap = 0;        // nodes between two new levels; no update leaves any
    std::uint32_t touched_percent = 50; // of the nodes below a touched one
};

/// Lays an octree out as an update would, with the same voxels, attributes and emission. Some nodes count as touched:
/// the root always, others only below touched nodes. The old nodes and voxels keep their positions, except the root,
/// which is node 0. Behind them stand the children of all touched nodes, level by level and in Morton order. Touched
/// ones have new children; the others are copies that share the old children. Touched leaves have their own attributes
/// behind the old ones, from a multiple of 32 on. Nodes that no ray can reach are spoiled: their masks are full and
/// their children wrong. The result has no levels, as tracing must not need them.
DeviceTree relocate(vk::HeadlessDevice& device, const DeviceTree& octree, const RelocateOptions& options = {});

} // namespace zvo::test
