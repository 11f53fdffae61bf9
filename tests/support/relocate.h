// SPDX-License-Identifier: MIT
// Octrees whose nodes stand where those of a dynamic update do.
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo::test
{

struct RelocateOptions
{
    std::uint32_t gap = 0;              // nodes, and at least as many voxels, between the old ones and the new ones
    std::uint32_t level_gap = 0;        // nodes between the new ones of two levels: no update leaves any
    std::uint32_t touched_percent = 50; // of the nodes below a touched one
};

/// An octree, and where its parts come from.
struct Relocated
{
    static constexpr std::uint32_t kUnused = ~0U;

    DeviceTree octree;                          // without levels: nobody who traces may need them
    std::vector<std::uint32_t> original_nodes;  // [node_count] of the octree that it was made from, or kUnused
    std::vector<std::uint32_t> original_voxels; // [voxel_count]
};

/// An octree with the voxels, attributes and emission of octree, laid out as an update would: some nodes count as
/// touched, the root always and others only below touched ones. The old nodes and voxels stand where they stood, but
/// for the root, which is node 0. Behind them, level by level and in Morton order, stand the children of all touched
/// nodes: touched ones with children of their own, the others as copies that share the old children. Touched leaves
/// have attributes of their own behind the old ones, from a multiple of 32 on. What no ray can reach is spoiled: nodes
/// are full and their children wrong.
Relocated relocate(vk::HeadlessDevice& device, const DeviceTree& octree, const RelocateOptions& options = {});

} // namespace zvo::test
