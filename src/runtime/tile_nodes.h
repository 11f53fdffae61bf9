// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/tree/tree_data.h"
#include "core/upload/gpu_scene.h"
#include "shared/octree.h"
#include "vk/headless.h"

#include <cstdint>
#include <span>
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

/// The nodes above the roots of a grid's tiles: an octree whose voxels are the tiles with these Morton codes. codes:
/// ascending. tile_depth: tiles are cubes of (1 << tile_depth)^3 voxels; an even number, less than grid.depth.
TreeData octreeOfTiles(const Grid& grid, std::uint32_t tile_depth, std::span<const std::uint64_t> codes);

/// The attributes of all nodes of the grid's octree, depth first. Those of the nodes above the tiles are averaged here,
/// as in every octree. scene: the one that was voxelized. Waits. Throws Error{Memory} when the device's budget does not
/// suffice for the nodes above the tiles.
std::vector<gpu::Attribute> joinNodes(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid,
                                      std::uint32_t tile_depth, const TileNodes& tiles);

} // namespace zvo
