// SPDX-License-Identifier: MIT
// What the programs are asked for in the same way: devices, scenes, places of results.
#pragma once

#include "core/scene/scene.h"
#include "core/tree/attribute_format.h"
#include "io/scene/load_scene.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

/// Which device, and how much of it.
struct DeviceOptions
{
    std::string device; // name part, index or "cpu"; empty: the best one
    bool validation = false;
    bool gpu_validation = false;             // also instruments the kernels
    std::uint64_t memory_limit = UINT64_MAX; // bytes
    std::uint32_t dispatch_ms = 400;         // aimed at for one submission of work; 0: never split
};

/// A grid's place as a report states it.
struct GridPosition
{
    glm::vec3 origin{0.0F};
    float voxel_size = 1.0F;
};

/// What becomes voxels, and how.
struct VoxelOptions
{
    std::vector<std::filesystem::path> scenes; // files that make one scene, or one scene file
    LoadOptions load;
    std::optional<std::filesystem::path> scenes_folder; // where else what a scene file names may lie
    std::optional<double> time;                         // seconds, from 0 on
    std::optional<std::uint32_t> depth;                 // not given: the scene file's, or 9
    Coverage coverage = TreeBuildInfo().coverage;
    AttributeFormat attributes = AttributeFormat::Bytes8; // of the voxels; packed ones are of build alone
    std::optional<Bounds> bounds;                         // the cube from this box's minimum corner on
    std::optional<GridPosition> grid_position;            // exactly this grid; neither: the cube around the scene

    [[nodiscard]] bool hasAttributes() const { return attributes != AttributeFormat::None; }
};

/// Where results go. "-" is standard output.
struct OutputOptions
{
    std::string path;
    std::string json; // empty: no report
    bool overwrite = false;
};

} // namespace zvo::cli
