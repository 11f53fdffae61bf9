// SPDX-License-Identifier: MIT
#include "demo/app/settings.h"

#include "common/progress.h"
#include "common/session.h"
#include "core/base/read_file.h"
#include "demo/app/view_settings.h"
#include "io/file/atomic_file.h"
#include "io/file/json_cursor.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

namespace zvo::demo
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "zvo.demo_settings/1";

// Calls read with the member of that name, if there is one.
template <typename Read> void with(const JsonCursor& object, std::string_view name, Read read)
{
    if (const std::optional<JsonCursor> value = object.find(name))
    {
        read(*value);
    }
}

ViewState readViewState(const JsonCursor& object)
{
    std::vector<std::string_view> keys;
    std::ranges::transform(viewSettings(), std::back_inserter(keys), &ViewSetting::key);
    object.allowKeys(keys);
    ViewState view;
    for (const ViewSetting& setting : viewSettings())
    {
        with(object, setting.key, [&](const JsonCursor& value) { setting.read(view, value); });
    }
    return view;
}

constexpr std::array<std::string_view, 3> kBrushActions = {"carve", "fill", "paint"};
constexpr std::array<std::string_view, 2> kBrushShapes = {"sphere", "box"};
constexpr std::array<std::string_view, 3> kBrushForms = {"stroke", "box", "flood"};

ToolState readBrush(const JsonCursor& object)
{
    object.allowKeys({"action", "shape", "radius", "color", "emission", "form", "tolerance"});
    ToolState brush;
    brush.action = static_cast<BrushAction>(object.at("action").oneOf(kBrushActions));
    brush.shape = static_cast<BrushShape>(object.at("shape").oneOf(kBrushShapes));
    brush.radius = static_cast<int>(object.at("radius").whole(0, gpu::kBrushRadiusMax));
    const glm::vec3 color(object.at("color").vector());
    brush.color = {color.x, color.y, color.z};
    with(object, "emission",
         [&](const JsonCursor& value)
         { brush.emission = static_cast<float>(value.positive(ToolState::kEmissionMax)); });
    with(object, "form",
         [&](const JsonCursor& value) { brush.form = static_cast<BrushForm>(value.oneOf(kBrushForms)); });
    with(object, "tolerance",
         [&](const JsonCursor& value)
         { brush.tolerance = static_cast<int>(value.whole(0, ToolState::kToleranceMax)); });
    return brush;
}

Json brushJson(const ToolState& brush)
{
    Json json = {{"action", kBrushActions[static_cast<std::size_t>(brush.action)]},
                 {"shape", kBrushShapes[static_cast<std::size_t>(brush.shape)]},
                 {"radius", brush.radius},
                 {"color", {double{brush.color[0]}, double{brush.color[1]}, double{brush.color[2]}}},
                 {"form", kBrushForms[static_cast<std::size_t>(brush.form)]},
                 {"tolerance", brush.tolerance}};
    if (brush.emission > 0.0F)
    {
        json["emission"] = double{brush.emission};
    }
    return json;
}

} // namespace

std::optional<std::filesystem::path> settingsFile()
{
    const std::filesystem::path folder = cli::userFolder("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? std::nullopt : std::optional(folder / "demo.json");
}

Settings parseSettings(std::string_view text, const std::filesystem::path& file)
{
    const nlohmann::json document = parseJsonStrictly(text, file);
    const JsonCursor object(document, file);
    object.allowKeys({"schema", "window", "panels", "keys", "view", "brush", "scenes"});
    static_cast<void>(object.at("schema").oneOf({kSchema}));
    Settings settings;
    with(object, "window",
         [&](const JsonCursor& value)
         {
             value.allowKeys({"width", "height"});
             settings.window = {value.at("width").whole(1, kImageEdgeMax), value.at("height").whole(1, kImageEdgeMax)};
         });
    with(object, "panels", [&](const JsonCursor& value) { settings.shows_panels = value.flag(); });
    with(object, "keys", [&](const JsonCursor& value) { settings.shows_keys = value.flag(); });
    with(object, "view", [&](const JsonCursor& value) { settings.view = readViewState(value); });
    with(object, "brush", [&](const JsonCursor& value) { settings.brush = readBrush(value); });
    with(object, "scenes",
         [&](const JsonCursor& value)
         {
             for (const JsonCursor& scene : value.items())
             {
                 settings.scenes.push_back(readMemory(scene));
             }
         });
    return settings;
}

std::string settingsText(const Settings& settings)
{
    Json json;
    json["schema"] = kSchema;
    json["window"] = {{"width", settings.window.width}, {"height", settings.window.height}};
    json["panels"] = settings.shows_panels;
    json["keys"] = settings.shows_keys;
    for (const ViewSetting& setting : viewSettings())
    {
        if (Json value = setting.write(settings.view); !value.is_null())
        {
            json["view"][setting.key] = std::move(value);
        }
    }
    json["brush"] = brushJson(settings.brush);
    json["scenes"] = Json::array();
    for (const SceneMemory& scene : settings.scenes)
    {
        json["scenes"].push_back(memoryJson(scene));
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; // names of files may be no UTF-8
}

Settings readSettings(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
    {
        Settings first;
        first.is_first = true;
        return first;
    }
    try
    {
        const std::vector<std::uint8_t> bytes = readFile(file);
        return parseSettings(asText(bytes), file);
    }
    catch (const Error& error)
    {
        cli::talk(fmt::format("warning: settings are not used: {}", error.what()));
        return {};
    }
}

void writeSettings(const std::filesystem::path& file, const Settings& settings)
{
    try
    {
        std::error_code failure;
        std::filesystem::create_directories(file.parent_path(), failure);
        const std::string text = settingsText(settings);
        writeFileAtomically(file, std::as_bytes(std::span(text)), Overwrite::Allow);
    }
    catch (const Error& error)
    {
        cli::talk(fmt::format("warning: settings are not kept: {}", error.what()));
    }
}

} // namespace zvo::demo
