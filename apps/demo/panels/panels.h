// SPDX-License-Identifier: MIT
// The panels over the picture, one in each panel_*.cpp. They are built within a frame of Dear ImGui. They show their
// arguments, and change those that the user changes.
#pragma once

#include "demo/input/camera_control.h"
#include "demo/input/timeline.h"
#include "demo/panels/frame_stats.h"
#include "demo/panels/notices.h"
#include "demo/world/loading.h"
#include "demo/world/tool.h"
#include "demo/world/world.h"
#include "vk/device.h"

#include <cstdint>
#include <optional>
#include <string>

namespace zvo::demo
{

/// Which panels are shown and open.
struct PanelState
{
    bool shows_panels = true;
    bool shows_keys = false;
};

/// Device memory by purpose, in bytes.
struct MemoryUse
{
    std::uint64_t geometry = 0;   // of the static part
    std::uint64_t attributes = 0; // of the static part
    std::uint64_t pictures = 0;
    std::uint64_t used = 0; // all use: the above, dynamic objects, overlays, node paths and the rest
    std::uint64_t held = 0; // allocated from the driver
};

/// Shows frames a second, Mrays/s, memory, and the device's times by pass.
void performancePanel(const FrameStats& stats, const MemoryUse& memory);

/// Shows the world's contents, and its time, which can be changed.
void scenePanel(const World& world, Timeline& timeline);

/// The user's requests in the build panel.
struct BuildAnswer
{
    std::optional<WorldOptions> rebuild; // with other options
    bool cancels = false;
};

/// Shows resolution, coverage and structure of the world, which can be chosen if it was voxelized, and the progress of
/// loading. loading: null for none.
BuildAnswer buildPanel(const WorldOptions& options, const World& world, const Loading* loading);

/// Shows the name of what is loaded first, and how far it is, in the middle of the window.
void loadingPanel(const WorldOptions& options, const Loading& loading);

/// The user's requests in the tools panel.
struct ToolsAnswer
{
    bool undoes = false;
    bool redoes = false;
    bool saves = false;
};

/// Shows the tool of the left button, the brush, and the history.
ToolsAnswer toolsPanel(ToolState& state, const World& world);

/// Shows and changes the camera's field of view.
void cameraPanel(CameraControl& camera);

/// A pixel under the pointer, and what its ray hits.
struct InspectedPixel
{
    glm::uvec2 position{0U}; // in the window
    gpu::PixelReport report{};
};

/// Shows the voxel at the pixel under the pointer.
void inspectorPanel(const std::optional<InspectedPixel>& pixel, const Grid& grid);

/// Shows the compiler's message until the user closes the panel, which clears the message. An empty message shows
/// nothing.
void shadersPanel(std::string& message);

/// Shows the table of keys.
void keysPanel(bool& is_open);

/// Shows the program's messages.
void noticesPanel(const Notices& notices);

} // namespace zvo::demo
