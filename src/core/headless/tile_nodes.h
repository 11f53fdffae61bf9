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

/// The tiles of a grid that have voxels, all of the same size, and the attributes of their nodes.
struct TileNodes
{
    std::vector<std::uint64_t> codes;                    // Morton codes among tiles, ascending
    std::vector<gpu::Attribute> roots;                   // [codes] attributes of the tiles' roots
    std::vector<std::vector<gpu::Attribute>> attributes; // [codes] depth first, from the tile's root on
};

/// The attributes of all nodes of the grid's octree, depth first. Those of the top_levels levels of nodes above the
/// tiles are averaged here, as in every octree. scene: the one that was voxelized. Waits. Throws Error{Memory} when the
/// device's budget does not suffice for the nodes above the tiles.
std::vector<gpu::Attribute> joinNodes(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid,
                                      std::size_t top_levels, const TileNodes& tiles);

} // namespace zvo
