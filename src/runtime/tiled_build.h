// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/deform/dynamic_object.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace zvo
{

/// Options of buildByTiles.
struct TiledOptions
{
    Coverage coverage = Coverage::Thin;
    AttributeFormat attributes = AttributeFormat::Bytes8;

    /// Size of the largest tiles: (1 << tile_depth)^3 voxels; an even number. A grid whose depth is not above it is
    /// built whole.
    std::uint32_t tile_depth = 12;

    std::function<void(double done)> progress = nullptr; // called now and then with the part of the grid that is done
};

/// The result of buildByTiles, and how it came about.
struct TiledResult
{
    TreeData tree;                                // a DAG
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason; only reasons that occurred
    std::uint32_t tile_count = 0;                 // tiles with voxels that were built on their own
    std::uint32_t retry_count = 0;                // runs that were thrown away because something was too small
    std::vector<vk::PassTime> passes; // of the runs that succeeded: operations "voxelize", "octree" and "svdag"
};

/// Makes the DAG of a scene with device memory for only a part of it at a time. Tiles are voxelized, built and
/// compressed one by one, in Morton order, and merged into one DAG; attributes go to the host's memory. A tile for
/// which the device's budget does not suffice is divided into 64 smaller tiles, and so on. The result has the same
/// bytes as that of buildOctree and compress for the whole grid. Throws Error{Memory} when the budget does not suffice
/// for the smallest tiles or for the DAG, and what buildOctree throws.
TiledResult buildByTiles(vk::HeadlessDevice& device, const PosedGpuScene& scene, const Grid& grid,
                         const TiledOptions& options);

} // namespace zvo
