// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "demo/world/view_state.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace zvo::demo
{

/// What the program remembers from one run to the next.
struct Settings
{
    PictureSize window = {1280, 720}; // in its own units
    bool shows_panels = true;
    bool shows_keys = false;
    ViewState view;

    bool operator==(const Settings&) const = default;
};

/// $XDG_CONFIG_HOME/zvo/demo.json, or the same below ~/.config; nothing where there is no such place.
std::optional<std::filesystem::path> settingsFile();

/// The settings in a file's text; what it does not name is as in a new program. Throws Error{Input} that begins with
/// file, for a file that is damaged.
Settings parseSettings(std::string_view text, const std::filesystem::path& file);

/// A file with these settings, which parseSettings() reads.
std::string settingsText(const Settings& settings);

/// The settings in a file. One that is not there gives those of a new program; so does one that is damaged, which is
/// told.
Settings readSettings(const std::filesystem::path& file);

/// Writes them, in a folder that is made if it is not there. What goes wrong is told.
void writeSettings(const std::filesystem::path& file, const Settings& settings);

} // namespace zvo::demo
