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

/// How buildByTiles works.
struct TiledOptions
{
    Coverage coverage = Coverage::Thin;
    AttributeFormat attributes = AttributeFormat::Bytes8;

    /// Of the largest tiles: (1 << tile_depth)^3 voxels, an even number. Depths of the grid that are not above it are
    /// built whole.
    std::uint32_t tile_depth = 12;

    std::function<void(double done)> progress = nullptr; // told now and then: the part of the grid that is done
};

/// A DAG and how it came about.
struct TiledResult
{
    TreeData tree;                                // a DAG
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason; only reasons that occurred
    std::uint32_t tile_count = 0;                 // that were built on their own and have voxels
    std::uint32_t retry_count = 0;                // runs that were thrown away because something was too small
    std::vector<vk::PassTime> passes; // of the runs that succeeded: operations "voxelize", "octree" and "svdag"
};

/// Makes the DAG of a scene with device memory for a part of it at a time: tiles are voxelized, built and compressed
/// one by one, in Morton order, and merged into one DAG; what voxels look like goes to the host's memory. Where the
/// device's budget does not suffice for a tile, it is taken in 64 parts, and so on. The result is, byte for byte, what
/// buildOctree and compress make of the whole grid. Throws Error{Memory} when the budget does not suffice for the
/// smallest tiles or for the DAG, and as buildOctree.
TiledResult buildByTiles(vk::HeadlessDevice& device, const PosedGpuScene& scene, const Grid& grid,
                         const TiledOptions& options);

} // namespace zvo
