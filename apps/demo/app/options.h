// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/present/present.h"
#include "core/tree/tree_data.h"
#include "demo/app/view_settings.h"
#include "demo/input/elapsed.h"
#include "zvo/dynamic_tree.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zvo::demo
{

/// The options of the command line. Those that are not given have the values of the settings.
struct DemoOptions
{
    cli::VoxelOptions voxels; // scenes: what is shown first; may be none
    std::optional<TreeStructure> structure;
    cli::DeviceOptions device;
    std::optional<PictureSize> size; // of the window

    std::string camera; // as in `zvo render`
    std::optional<std::filesystem::path> camera_path;
    std::vector<ViewChange> view_changes; // to the view of the settings
    cli::EnvironmentOptions environment;
    std::uint32_t frames_in_flight = DynamicTreeInfo().frames_in_flight;

    std::optional<std::uint64_t> frame_count; // frames after which the program ends
    std::optional<FixedStep> fixed_step;
    bool hide_ui = false;
    std::optional<std::filesystem::path> shaders; // folder of the sources that F5 compiles
    std::optional<std::filesystem::path> input_script;
    std::optional<std::filesystem::path> record_input;
    std::string screenshot; // of the last frame; empty: none
    std::string json;       // statistics; empty: none
    bool overwrite = false;

    /// Whether the settings of earlier runs apply. A run of a fixed number of frames must be the same for everyone, so
    /// it ignores them.
    [[nodiscard]] bool usesSettings() const { return !frame_count.has_value(); }
};

/// Reads the command line. Nothing if it asks for a text, help or version, which is printed. Throws Error{Usage}, one
/// line, for anything that is not understood.
std::optional<DemoOptions> parseCommandLine(int argc, const char* const* argv);

} // namespace zvo::demo
