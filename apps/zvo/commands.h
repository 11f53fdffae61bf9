// SPDX-License-Identifier: MIT
// The commands of zvo, and their options.
#pragma once

#include "common/names.h"
#include "common/scene_options.h"
#include "core/frame/frame_options.h"
#include "core/path/path_tracer.h"
#include "core/scene/scene.h"
#include "core/tree/tree_data.h"
#include "io/scene/load_scene.h"
#include "query_files.h"
#include "zvo/query.h"
#include "zvo/types.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

inline constexpr auto kPathForms =
    std::to_array<Named<PathForm>>({{"stages", PathForm::Stages}, {"kernel", PathForm::OneKernel}});

/// What a picture is made of unless options say otherwise.
inline FrameOptions usualFrame()
{
    FrameOptions frame;
    frame.trace.occlusion_rays = 8; // of each sample, in other directions
    return frame;
}

struct RenderOptions
{
    VoxelOptions voxels;
    DeviceOptions device;
    OutputOptions output;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::string camera;             // as given; empty: the scene's first one, or a fitting one
    std::vector<std::string> sheet; // of all of these cameras, in its place, one picture is made
    std::optional<std::filesystem::path> camera_path;
    FrameOptions frame = usualFrame();
    std::optional<glm::dvec3> to_sun;     // direction, any length
    EnvironmentOptions environment;       // not of Integrator::Primary
    std::optional<std::uint32_t> samples; // a pixel
    std::optional<double> time_limit;     // seconds, after which no sample begins; of pictures with samples
    std::optional<float> focus;           // distance; not given: of what is at the picture's middle
    std::uint32_t settle = 128;           // frames before the first picture; Integrator::Cache and Cones
    bool aovs = false;                    // writes what the picture shows beside its light, too; Integrator::Path
    std::optional<std::pair<std::uint32_t, std::uint32_t>> frames; // first and last
    bool turntable = false;                                        // frames are those of a camera that turns
    std::optional<std::uint32_t> quality;                          // of .jpg and .webp
    std::optional<TreeStructure> structure; // of the static part; not given: an octree, or the file's
    bool rebuild = false;                   // voxelizes everything for each picture, instead of merging dynamic objects

    /// Whether pictures may hold radiance as it is, of any brightness.
    [[nodiscard]] bool hasRadiance() const
    {
        return frame.integrator != Integrator::Primary || frame.trace.view == View::Color;
    }

    /// The samples of a pixel: primary rays, paths, or frames.
    [[nodiscard]] std::uint32_t sampleCount() const
    {
        return samples.value_or(frame.integrator == Integrator::Primary ? 4 : usesCache(frame.integrator) ? 16 : 64);
    }
};

/// `zvo render`: voxelizes scenes and writes a picture of them, or a series. Throws Error.
void render(const RenderOptions& options);

/// Throws Error{Usage} if options have no effect with the integrator, or the output.
void checkIntegratorOptions(const RenderOptions& options);

/// Throws Error{Usage} if options have no effect on the tree of a file.
void checkTreeOptions(const RenderOptions& options);

struct VoxelizeOptions
{
    VoxelOptions voxels;
    DeviceOptions device;
    OutputOptions output;
    std::string format; // "morton" or "ply"; empty: the output's extension says
};

/// `zvo voxelize`: writes a scene's voxels. Throws Error.
void voxelize(const VoxelizeOptions& options);

struct BuildFileOptions
{
    VoxelOptions voxels;
    std::optional<std::uint32_t> distance;  // voxels: distances in place of a tree
    std::optional<TreeStructure> structure; // not given: a DAG
    DeviceOptions device;
    OutputOptions output;
};

/// `zvo build`: voxelizes scenes and writes the tree to a .zvo file, or distances to a .nvdb file. Throws Error.
void buildFile(const BuildFileOptions& options);

struct InspectOptions
{
    std::filesystem::path file;
    bool json = false;
};

/// `zvo inspect`: checks a .zvo or .vox file and reports its contents on standard output. Throws Error{Input}.
void inspect(const InspectOptions& options);

struct ValidateOptions
{
    std::filesystem::path file;
};

/// `zvo validate`: checks a .zvo or .vox file, and that the nodes of a DAG differ; reports a sound file on standard
/// output. Throws Error{Input}.
void validate(const ValidateOptions& options);

struct ConvertOptions
{
    std::filesystem::path file;
    OutputOptions output;
    std::string format;                             // empty: the output's extension says
    TreeStructure structure = TreeStructure::Svdag; // of a .zvo output
    bool strict = false;                            // refuses to leave something out
    DeviceOptions device;
};

/// `zvo convert`: reads a tree or voxels and writes them as another kind of file. Throws Error.
void convert(const ConvertOptions& options);

struct EditOptions
{
    std::filesystem::path file;
    std::filesystem::path script;
    OutputOptions output;
    std::string format;                     // empty: the output's extension says
    std::optional<TreeStructure> structure; // of a .zvo output; not given: as the file
    bool strict = false;                    // refuses to leave something out
    DeviceOptions device;
};

/// `zvo edit`: carves, fills and paints voxels of a tree as a script says, and writes the result. Throws Error.
void edit(const EditOptions& options);

/// What a step of `zvo algebra` does.
enum class AlgebraKind : std::uint8_t
{
    Unite,
    Intersect,
    Subtract,
    Dilate,
    Erode,
    Open,
    Close,
    Enclose,
    KeepLargest,
    KeepFrom
};

struct AlgebraStep
{
    AlgebraKind kind = AlgebraKind::Unite;
    std::filesystem::path file; // of a second tree
    std::uint64_t number = 0;   // of voxels, or of components
};

struct AlgebraOptions
{
    std::filesystem::path file;
    std::vector<AlgebraStep> steps; // in the order of the command line
    std::optional<bool> corners;    // neighbours are all 26, or the 6 across faces; not given: 26 of components, else 6
    std::string components;         // a CSV file of their sizes, or empty
    OutputOptions output;           // its path may be empty
    std::string format;             // empty: the output's extension says
    std::optional<TreeStructure> structure; // of a .zvo output; not given: a DAG
    bool strict = false;                    // refuses to leave something out
    DeviceOptions device;
};

/// `zvo algebra`: makes one tree of others: sets, morphology, components, enclosed space. Throws Error.
void algebra(const AlgebraOptions& options);

struct QueryOptions
{
    std::filesystem::path file;
    std::optional<QueryKind> kind;
    std::filesystem::path questions;   // "-": standard input
    std::optional<QueryFormat> format; // of questions and answers; not given: as the extensions say
    OutputOptions output;
    DeviceOptions device;
};

/// `zvo query`: answers questions to a tree. Throws Error.
void query(const QueryOptions& options);

struct InfoOptions
{
    std::string device;
    bool json = false;
};

/// `zvo info`: lists the devices on standard output, and the one that would be used. Throws Error{Device} afterwards if
/// none would be.
void info(const InfoOptions& options);

} // namespace zvo::cli
