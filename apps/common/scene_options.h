// SPDX-License-Identifier: MIT
// Options that the programs share: devices, scenes, outputs.
#pragma once

#include "core/octree/octree_builder.h"
#include "core/scene/scene.h"
#include "core/tree/attribute_format.h"
#include "io/scene/load_scene.h"
#include "vk/tuning.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

/// The device, and how much of it may be used.
struct DeviceOptions
{
    std::string device; // name part, index or "cpu"; empty: the best one
    bool validation = false;
    bool gpu_validation = false;             // also instruments the kernels
    std::uint64_t memory_limit = UINT64_MAX; // bytes
    std::uint32_t dispatch_ms = 400;         // target for one submission of work; 0: never split
    vk::TuningValues tuning;                 // in place of what zvo chooses by device

    friend bool operator==(const DeviceOptions&, const DeviceOptions&) = default;
};

/// Origin and voxel size of a grid, as a report states them.
struct GridPosition
{
    glm::vec3 origin{0.0F};
    float voxel_size = 1.0F;
};

/// What is voxelized, and how.
struct VoxelOptions
{
    std::vector<std::filesystem::path> scenes; // files that make one scene, or one scene file
    LoadOptions load;
    std::optional<std::filesystem::path> scenes_folder; // another folder for the files that a scene file names
    std::optional<double> time;                         // seconds, from 0 on
    std::optional<std::uint32_t> depth;                 // not given: the scene file's, or 9
    std::optional<std::uint32_t> margin;                // free voxels around the scene; not given: default_margin
    std::uint32_t default_margin = 0;
    Coverage coverage = TreeBuildInfo().coverage;
    Fill fill = Fill::None;
    Shell shell = Shell::Surface;
    AttributeFormat attributes = AttributeFormat::Bytes8; // of the voxels; packed formats only for build
    std::optional<Bounds> bounds;                         // the cube from this box's minimum corner on
    std::optional<GridPosition> grid_position;            // exactly this grid; neither: the cube around the scene
    bool ground = false; // a disc below the scene, in a cube that is twice as wide unless the grid is given

    [[nodiscard]] bool hasAttributes() const { return attributes != AttributeFormat::None; }
    [[nodiscard]] BuildOptions build() const
    {
        return {.coverage = coverage, .attributes = hasAttributes(), .fill = fill, .shell = shell};
    }
};

/// What a scene is lit by, in pictures with samples.
struct EnvironmentOptions
{
    std::optional<std::filesystem::path> map; // or "none": no light; not given: the simple sky
    double turn = 0.0;                        // degrees, counterclockwise from above
    float strength = 1.0F;
    float background_blur = 0.0F; // degrees by which the camera sees the map blurred
};

/// The outputs of a command. "-" is standard output.
struct OutputOptions
{
    std::string path;
    std::string json; // empty: no report
    bool overwrite = false;
};

} // namespace zvo::cli
