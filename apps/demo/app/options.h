// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/present/present.h"
#include "core/trace/trace.h"
#include "core/tree/tree_data.h"
#include "demo/input/elapsed.h"
#include "vk/swapchain.h"
#include "zvo/dynamic_tree.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

namespace zvo::demo
{

/// What the command line asks for. What is not given is as the settings have it.
struct DemoOptions
{
    cli::VoxelOptions voxels; // scenes: none, or what is shown first
    std::optional<TreeStructure> structure;
    cli::DeviceOptions device;
    std::optional<PictureSize> size; // of the window

    std::string camera; // as in `zvo render`
    std::optional<std::filesystem::path> camera_path;
    std::optional<View> view;
    std::optional<std::uint32_t> occlusion_rays;
    std::optional<glm::dvec3> to_sun;
    std::optional<float> exposure;
    std::optional<float> detail_pixels;
    std::optional<double> internal_scale; // above 0, at most 1
    std::optional<vk::PresentMode> present_mode;
    std::uint32_t frames_in_flight = DynamicTreeInfo().frames_in_flight;

    std::optional<std::uint64_t> frame_count; // after which the program ends
    std::optional<FixedStep> fixed_step;
    bool hide_ui = false;
    std::optional<std::filesystem::path> shaders; // folder of the sources that F5 compiles
    std::optional<std::filesystem::path> input_script;
    std::optional<std::filesystem::path> record_input;
    std::string screenshot; // of the last frame; empty: none
    std::string json;       // statistics; empty: none
    bool overwrite = false;

    /// A run of so many frames is to be the same for everyone: settings play no part.
    [[nodiscard]] bool usesSettings() const { return !frame_count.has_value(); }
};

/// Reads the command line: options, or text to print and nothing more (help, version). Throws Error{Usage}, one line,
/// for anything that is not understood.
std::variant<std::string, DemoOptions> parseCommandLine(int argc, const char* const* argv);

} // namespace zvo::demo
