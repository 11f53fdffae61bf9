// SPDX-License-Identifier: MIT
// The settings of the view, each of them said once: as an option, in the settings' file, and in the view panel.
#pragma once

#include "demo/world/view_state.h"
#include "io/file/json_cursor.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::demo
{

/// Further values that the view panel shows.
struct ViewInfo
{
    double internal_scale = 1; // in use
    vk::PresentMode mode = vk::PresentMode::Fifo;
    double camera_speed = 1;                   // world units a second
    std::optional<std::uint32_t> samples;      // a pixel, where the picture has several
    std::optional<std::uint32_t> cache_frames; // of the radiance cache, where there is one
    bool has_map = false;                      // an environment map lights the picture
};

using ViewChange = std::function<void(ViewState& view)>;

struct ViewSetting
{
    /// The option of a setting in --help.
    struct Option
    {
        const char* group = nullptr; // null: there is no option
        std::string type = {};       // of its argument; empty: a flag, which sets true
        std::string help = {};
    };

    std::string key; // in the settings' file
    Option option;

    /// What an option with this argument does. Throws Error{Usage}, which names the option.
    std::function<ViewChange(std::string_view name, const std::string& argument)> parse;

    /// Takes the value in the settings' file. Throws Error{Input}.
    std::function<void(ViewState& view, const JsonCursor& value)> read;

    /// The value for the settings' file; null: it is left out.
    std::function<nlohmann::ordered_json(const ViewState& view)> write;

    /// Shows the setting in the view panel, and changes it. Null: it is not there.
    void (*show)(ViewState& view, const ViewInfo& info);
    bool (*applies)(const ViewState& view); // whether it has an effect; otherwise it is not shown

    /// The option's name, such as --internal-scale.
    [[nodiscard]] std::string optionName() const;
};

/// All settings, in the order of --help, of the file and of the panel.
const std::vector<ViewSetting>& viewSettings();

/// Shows and changes view, light, detail and resolution.
void viewPanel(ViewState& view, const ViewInfo& info);

} // namespace zvo::demo
