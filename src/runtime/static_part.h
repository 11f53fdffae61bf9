// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "core/tree/device_tree.h"
#include "runtime/trees.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

/// Functions that are called while a static part is made: before each operation with its name, while images are
/// decoded, for each warning, and with the octree before it is compressed.
struct StaticListener
{
    std::function<void(std::string_view)> operation = [](std::string_view) {};
    std::function<void(const BuildResult&)> built = [](const BuildResult&) {};
    std::function<void(double)> decoded = [](double) {};                      // the fraction of the images
    std::function<void(const std::string&)> warn = [](const std::string&) {}; // GpuScene::warnings
};

/// Counts and sizes of a static part.
struct StaticInfo
{
    std::uint64_t triangle_count = 0;
    std::uint64_t voxel_count = 0;
    OpenSurfaces open = {};
    std::uint64_t node_count = 0;
    std::uint64_t geometry_bytes = 0; // of nodes; for a DAG, also of lists
    std::uint64_t attribute_bytes = 0;
    std::map<std::string, std::uint64_t> dropped = {}; // triangles left out, by reason
    std::vector<vk::PassTime> passes = {};             // of voxelization and construction; empty for a tree from a file
    std::vector<vk::PassTime> compress_passes = {};    // of compression; empty for an octree
};

/// The part of a scene that never moves, in device memory.
struct StaticPart
{
    DeviceTree tree;
    StaticInfo info;
};

/// Uploads scene, voxelizes it and, for a DAG, compresses the octree. Waits. emission_scale: as of uploadScene().
/// Throws Error{Memory}.
StaticPart makeStaticPart(vk::HeadlessDevice& device, Scene scene, const Grid& grid, const BuildOptions& options,
                          TreeStructure structure, const StaticListener& listener = {},
                          std::optional<float> emission_scale = std::nullopt);

} // namespace zvo
