// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/frame/frame_options.h"
#include "core/present/present.h"
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

/// The options of the command line. Those that are not given have the values of the settings.
struct DemoOptions
{
    cli::VoxelOptions voxels; // scenes: what is shown first; may be none
    std::optional<TreeStructure> structure;
    cli::DeviceOptions device;
    std::optional<PictureSize> size; // of the window

    std::string camera; // as in `zvo render`
    std::optional<std::filesystem::path> camera_path;
    std::optional<View> view;
    std::optional<Integrator> integrator;
    bool denoise = false;
    std::optional<std::uint32_t> occlusion_rays;
    std::optional<glm::dvec3> to_sun;
    std::optional<float> exposure;
    std::optional<float> detail_pixels;
    std::optional<double> internal_scale; // above 0, at most 1
    std::optional<vk::PresentMode> present_mode;
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

/// Reads the command line: options, or a text that is printed (help, version). Throws Error{Usage}, one line, for
/// anything that is not understood.
std::variant<std::string, DemoOptions> parseCommandLine(int argc, const char* const* argv);

} // namespace zvo::demo
