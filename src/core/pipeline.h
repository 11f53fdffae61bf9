// SPDX-License-Identifier: MIT
#pragma once

#include "core/coverage.h"
#include "core/gpu_scene.h"
#include "core/octree.h"
#include "core/voxelize.h"
#include "vk/headless.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

/// What buildOctree makes.
struct BuildOptions
{
    Coverage coverage = Coverage::Thin;
    bool attributes = true;
    std::optional<VoxelizeCapacities> capacities = std::nullopt; // where to start; by default, an estimate
    bool keep_sums = false; // of attributes, for BuildResult::sums: 28 bytes a voxel
};

/// GPU time of those passes that belong to an operation, "voxelize" or "octree": its kernels, and the fills of its
/// buffers.
double operationMs(std::span<const vk::PassTime> passes, std::string_view operation);

/// An octree and how it came about.
struct BuildResult
{
    Octree octree;
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason; only reasons that occurred
    std::vector<vk::PassTime> passes;             // of the runs that succeeded
    VoxelizeCapacities capacities;                // that sufficed
    std::uint32_t retry_count = 0;                // runs that were thrown away because something was too small
    FragmentSums sums;                            // with BuildOptions::keep_sums

    /// operationMs() of the passes.
    [[nodiscard]] double stageMs(std::string_view operation) const { return operationMs(passes, operation); }
};

/// Runs all of the static half on device: voxelize, build, attributes. Waits between the operations to learn sizes;
/// what turns out too small grows, and the operation runs again. Throws Error{Memory} when the device's budget does not
/// suffice and Error{Usage} for a depth outside 1 to Grid::kDepthMax. A scene without triangles in the grid gives an
/// octree without nodes. Of a tile (GridTile), an octree of the whole grid with what lies in it: its voxels and their
/// attributes are a slice, in Morton order, of what the whole grid gives, as long as no voxel has more than 65,535
/// fragments. dropped is that of the whole grid.
BuildResult buildOctree(vk::HeadlessDevice& device, const PlacedScene& scene, const GridTile& tile,
                        const BuildOptions& options);

/// The Morton codes of all voxels, ascending: voxel_count of them.
std::vector<std::uint64_t> voxelCodes(vk::HeadlessDevice& device, const Octree& octree);

} // namespace zvo
