// SPDX-License-Identifier: MIT
// The options of zvo-bench: a struct for each command, built of those that several commands have.
#pragma once

#include "common/scene_options.h"
#include "core/radiance/device_radiance_cache.h"
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

/// What is measured, on which device, and where the report goes.
struct BenchOptions
{
    std::vector<std::filesystem::path> scenes;         // empty: the usual ones in scene_folder
    std::optional<std::filesystem::path> scene_folder; // not given: scenes
    LoadOptions load;
    std::optional<std::vector<std::uint32_t>> depths; // not given: those that the command has
    Coverage coverage = TreeBuildInfo().coverage;
    bool attributes = true;
    DeviceOptions device;
    OutputOptions output; // path: unused
};

/// Of commands that measure the same several times.
struct RepeatedBenchOptions : BenchOptions
{
    std::uint32_t run_count = 5;
};

/// Of commands that can tell of each pass.
struct PassBenchOptions : RepeatedBenchOptions
{
    bool passes = false;
};

/// Of commands that compare pictures with one of very many paths.
struct LitBenchOptions : BenchOptions
{
    std::string camera;                     // as in RenderOptions
    std::uint32_t reference_samples = 1024; // a pixel of that picture
};

/// Pixels of the pictures whose rays are measured.
struct PictureSizeOptions
{
    std::uint32_t width = 640;
    std::uint32_t height = 360;
};

struct BenchBuildOptions : PassBenchOptions
{
    Fill fill = Fill::None;
};

struct BenchRaysOptions : PassBenchOptions
{
    std::string camera;
    std::vector<std::string> kinds; // of rays that are measured, too, as lists
};

struct BenchDynamicOptions : PassBenchOptions
{
    std::string camera;
    TreeStructure structure = TreeStructure::Svo; // of the static part
};

struct BenchEditOptions : RepeatedBenchOptions
{
    TreeStructure structure = TreeStructure::Svo;
};

struct BenchQueriesOptions : RepeatedBenchOptions
{
    std::uint32_t count = 1U << 20; // questions of each kind
};

struct BenchSolidOptions : RepeatedBenchOptions
{
};

struct BenchPathOptions : RepeatedBenchOptions, PictureSizeOptions
{
    std::string camera;
    std::vector<std::filesystem::path> environments; // maps
};

struct BenchCacheOptions : LitBenchOptions, PictureSizeOptions
{
    std::uint32_t faces = RadianceOptions().faces; // that a frame samples at most
    TreeStructure structure = TreeStructure::Svo;  // of the static part of scene files
};

struct BenchDenoiseOptions : LitBenchOptions
{
};

struct BenchBaselinesOptions : RepeatedBenchOptions
{
    std::string camera;
};

struct BenchBalanceOptions : RepeatedBenchOptions
{
};

struct BenchTuneOptions : RepeatedBenchOptions, PictureSizeOptions // scenes, depths: at most one
{
    std::string camera;
};

struct BenchReportOptions
{
    std::vector<std::filesystem::path> reports;   // earlier runs' JSON
    std::optional<std::filesystem::path> targets; // figures to compare them with
};

/// Does what the command line asks for. Throws Error{Usage}, one line, for anything that is not understood, and what
/// the command throws.
void runBenchCommandLine(int argc, const char* const* argv);

} // namespace zvo::cli
