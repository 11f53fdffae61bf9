// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "demo/app/scene_memory.h"
#include "demo/world/tool.h"
#include "demo/world/view_state.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::demo
{

/// What the program keeps from one run to the next.
struct Settings
{
    PictureSize window = {1280, 720}; // in its own units
    bool shows_panels = true;
    bool shows_keys = false;
    ViewState view;
    ToolState brush;                 // whatever the tool
    std::vector<SceneMemory> scenes; // the last one first
    bool is_first = false;           // there was no file; not in it

    bool operator==(const Settings&) const = default;
};

/// The path $XDG_CONFIG_HOME/zvo/demo.json, or the same below ~/.config; nothing if there is no such folder.
std::optional<std::filesystem::path> settingsFile();

/// The settings in a file's text; those that are missing have their defaults. Throws Error{Input}, beginning with
/// `file`, for a damaged file.
Settings parseSettings(std::string_view text, const std::filesystem::path& file);

/// A file with these settings, which parseSettings() reads.
std::string settingsText(const Settings& settings);

/// The settings in a file. A missing file gives the defaults; so does a damaged one, which is reported.
Settings readSettings(const std::filesystem::path& file);

/// Writes the settings, and makes the folder if needed. Failures are reported, not thrown.
void writeSettings(const std::filesystem::path& file, const Settings& settings);

} // namespace zvo::demo
