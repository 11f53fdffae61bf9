// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/upload/gpu_scene.h"
#include "shared/octree.h"
#include "vk/headless.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo
{

/// The tiles of a grid that have voxels, all equally large: where they stand, and what their nodes look like.
struct TileNodes
{
    std::vector<std::uint64_t> codes;                    // Morton codes among tiles, ascending
    std::vector<gpu::Attribute> roots;                   // [codes] averages of all below
    std::vector<std::vector<gpu::Attribute>> attributes; // [codes] depth first, from the tile's root on
};

/// The attributes of all nodes of the grid's octree, depth first: those above the tiles, top_levels levels of them, are
/// averages as octrees have them. scene: the one of the voxels. Waits. Throws Error{Memory} when the device's budget
/// does not suffice for the nodes above the tiles.
std::vector<gpu::Attribute> joinNodes(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid,
                                      std::size_t top_levels, const TileNodes& tiles);

} // namespace zvo
