// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/radiance/radiance_cache.h"
#include "io/scene/load_scene.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace zvo::cli
{

struct BenchOptions
{
    std::vector<std::filesystem::path> scenes;         // empty: the usual ones in scene_folder
    std::optional<std::filesystem::path> scene_folder; // not given: scenes
    LoadOptions load;
    std::optional<std::vector<std::uint32_t>> depths; // not given: 8, 9, 10, with balance 9, 10, 11, with edit 9
    std::uint32_t run_count = 5;
    Coverage coverage = TreeBuildInfo().coverage;
    bool attributes = true;
    std::string camera; // as in RenderOptions
    bool passes = false;
    bool balance = false;                   // load balance on generated scenes, and on scenes if any were named
    bool baselines = false;                 // the algorithms of zvo's sources beside zvo's
    bool dynamic = false;                   // updates against rebuilds of scenes with dynamic objects
    bool edit = false;                      // strokes of a brush
    bool path = false;                      // path tracing
    bool denoise = false;                   // pictures of few paths
    bool kept = false;                      // light that is kept on voxels
    bool tune = false;                      // what zvo chooses by device
    std::uint32_t reference_samples = 1024; // a pixel of the picture that they are compared with; with denoise, kept
    std::uint32_t kept_faces = RadianceOptions().faces; // that a frame of kept light samples at most
    std::vector<std::filesystem::path> environments;    // maps; with path
    std::uint32_t path_width = 640;                     // of the pictures whose rays path and tune measure, and of kept
    std::uint32_t path_height = 360;
    TreeStructure structure = TreeStructure::Svo; // of the static part; with dynamic or edit
    std::vector<std::filesystem::path> reports;   // earlier runs' JSON, to be told; empty: measure
    std::optional<std::filesystem::path> targets; // figures to compare them with; with reports
    DeviceOptions device;
    OutputOptions output; // path: unused
};

/// Adds the command `zvo bench` to app: parsing fills options.
CLI::App* addBench(CLI::App& app, BenchOptions& options);

} // namespace zvo::cli
