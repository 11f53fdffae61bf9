// SPDX-License-Identifier: MIT
#pragma once

#include "common/integrator_name.h"
#include "common/scene_options.h"
#include "core/frame/frame_options.h"
#include "core/scene/scene.h"
#include "core/tree/tree_data.h"
#include "io/scene/load_scene.h"
#include "zvo/types.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace zvo::cli
{

/// What a scene is lit by, in pictures with samples.
struct EnvironmentOptions
{
    std::optional<std::filesystem::path> map; // or "none": no light; not given: the simple sky
    double turn = 0.0;                        // degrees, counterclockwise from above
    float strength = 1.0F;
};

struct RenderOptions
{
    VoxelOptions voxels;
    DeviceOptions device;
    OutputOptions output;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::string camera; // as given; empty: the scene's first one, or a fitting one
    std::optional<std::filesystem::path> camera_path;
    FrameOptions frame;
    std::optional<glm::dvec3> to_sun;     // direction, any length
    EnvironmentOptions environment;       // this and the next two: of pictures with samples
    std::optional<std::uint32_t> samples; // a pixel
    std::optional<double> time_limit;     // seconds, after which no sample begins
    std::uint32_t settle = 128;           // frames before the first picture; Integrator::Cached and Cones
    bool aovs = false;                    // writes what the picture shows beside its light, too; Integrator::Path
    std::optional<std::pair<std::uint32_t, std::uint32_t>> frames; // first and last
    std::optional<TreeStructure> structure; // of the static part; not given: an octree, or the file's
    bool rebuild = false;                   // voxelizes everything for each picture, instead of merging dynamic objects

    /// Whether pictures are sums of samples.
    [[nodiscard]] bool hasSamples() const { return frame.integrator != Integrator::Primary; }

    /// The samples of a pixel: paths, or frames.
    [[nodiscard]] std::uint32_t sampleCount() const { return samples.value_or(keepsLight(frame.integrator) ? 16 : 64); }
};

struct VoxelizeOptions
{
    VoxelOptions voxels;
    DeviceOptions device;
    OutputOptions output;
    std::string format; // "morton" or "ply"; empty: the output's extension says
};

struct BuildFileOptions
{
    VoxelOptions voxels;
    TreeStructure structure = TreeStructure::Svdag;
    DeviceOptions device;
    OutputOptions output;
};

struct InspectOptions
{
    std::filesystem::path file;
    bool json = false;
};

struct ValidateOptions
{
    std::filesystem::path file;
};

struct ConvertOptions
{
    std::filesystem::path file;
    OutputOptions output;
    std::string format;                             // empty: the output's extension says
    TreeStructure structure = TreeStructure::Svdag; // of a .zvo output
    DeviceOptions device;
};

struct InfoOptions
{
    std::string device;
    bool json = false;
};

/// The command line's request: the options of one command, or a text that is printed (help, version).
using Command = std::variant<std::string, RenderOptions, VoxelizeOptions, BuildFileOptions, InspectOptions,
                             ValidateOptions, ConvertOptions, InfoOptions>;

/// Reads the command line. Throws Error{Usage}, one line, for anything that is not understood.
Command parseCommandLine(int argc, const char* const* argv);

} // namespace zvo::cli
