// SPDX-License-Identifier: MIT
#pragma once

#include "common/integrator.h"
#include "common/scene_options.h"
#include "core/path/path_tracer.h"
#include "core/radiance/radiance_cache.h"
#include "core/scene/scene.h"
#include "core/trace/trace.h"
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

/// How a picture is path traced. Environment, samples and time limit count for the others with
/// samples, too.
struct PathRenderOptions
{
    PathOptions path;
    std::optional<PathForm> form;                     // not given: by the device
    std::optional<std::uint32_t> samples;             // a pixel
    std::optional<double> time_limit;                 // seconds, after which no sample begins
    std::optional<std::filesystem::path> environment; // a map, or "none": no light; not given: the simple sky
    double environment_turn = 0.0;                    // degrees, counterclockwise from above
    float environment_strength = 1.0F;
    bool denoise = false;
    bool aovs = false; // writes what the picture shows beside its light, too
};

/// How a picture is made of light that is kept on voxels.
struct KeptRenderOptions
{
    RadianceOptions radiance;
    std::uint32_t settle = 128; // frames before the first picture
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
    View view = TraceOptions().view;
    std::uint32_t occlusion_rays = TraceOptions().occlusion_rays; // a pixel
    std::optional<glm::dvec3> to_sun;                             // direction, any length
    std::optional<float> exposure;                                // none: 1, or for paths by the picture's brightness
    float detail_pixels = TraceOptions().detail_pixels;           // rays stop at octree nodes up to this wide
    Integrator integrator = Integrator::Primary;
    PathRenderOptions paths;                                       // Integrator::Path, Cached and Cones
    KeptRenderOptions kept;                                        // Integrator::Cached and Cones
    std::optional<std::pair<std::uint32_t, std::uint32_t>> frames; // first and last
    std::optional<TreeStructure> structure; // of the static part; not given: an octree, or the file's
    bool rebuild = false;                   // voxelizes everything for each picture, instead of merging dynamic objects

    /// Whether pictures are sums of samples.
    [[nodiscard]] bool hasSamples() const { return integrator != Integrator::Primary; }

    /// The samples of a pixel: paths, or frames.
    [[nodiscard]] std::uint32_t sampleCount() const { return paths.samples.value_or(keepsLight(integrator) ? 16 : 64); }
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
