// SPDX-License-Identifier: MIT
// The panels over the picture, each in a file of its name. They are built within a frame of Dear ImGui. They show their
// arguments, and change those that the user changes.
#pragma once

#include "demo/input/timeline.h"
#include "demo/panels/frame_stats.h"
#include "demo/panels/notices.h"
#include "demo/world/loading.h"
#include "demo/world/tool.h"
#include "demo/world/view_state.h"
#include "demo/world/world.h"
#include "vk/device.h"

#include <optional>
#include <string>

namespace zvo::demo
{

/// Where the panels stand, and which of them are open.
struct PanelState
{
    bool shows_panels = true;
    bool shows_keys = false;
};

/// What the view panel also shows.
struct ViewInfo
{
    double internal_scale = 1; // in use
    vk::PresentMode mode = vk::PresentMode::Fifo;
    double camera_speed = 1; // world units a second
};

/// Device memory by what it is for, in bytes.
struct MemoryUse
{
    std::uint64_t geometry = 0;   // of what stands still
    std::uint64_t attributes = 0; // likewise
    std::uint64_t pictures = 0;
    std::uint64_t used = 0; // these, and all else: what moves, overlays, the beam grid
    std::uint64_t held = 0; // of the driver
};

/// Frames a second, Mrays/s, memory, and the device's time by pass.
void performancePanel(const FrameStats& stats, const MemoryUse& memory);

/// View, light, detail, resolution.
void viewPanel(ViewState& view, const ViewInfo& info);

/// What is shown, and when.
void scenePanel(const World& world, Timeline& timeline);

/// What was asked for in the build panel.
struct BuildAnswer
{
    std::optional<WorldOptions> rebuild; // with other options
    bool cancels = false;
};

/// Resolution, coverage and structure of what is shown, where they can be chosen; what is being made in the background.
/// loading: null for nothing.
BuildAnswer buildPanel(const WorldOptions& options, const World& world, const Loading* loading);

/// What was asked for in the tools panel.
struct ToolsAnswer
{
    bool undoes = false;
    bool redoes = false;
    bool saves = false;
};

/// What the left button does, the brush, what can be undone.
ToolsAnswer toolsPanel(ToolState& state, const World& world);

/// A pixel that the pointer was on, and what its ray met.
struct InspectedPixel
{
    glm::uvec2 position{0U}; // in the window
    gpu::PixelReport report{};
};

/// What the pixel under the pointer shows.
void inspectorPanel(const std::optional<InspectedPixel>& pixel, const Grid& grid);

/// Why shaders do not compile, until the user closes it, which clears the message; nothing for no message.
void shadersPanel(std::string& message);

/// The table of keys.
void keysPanel(bool& is_open);

/// What the program has to say.
void noticesPanel(const Notices& notices);

} // namespace zvo::demo
