// SPDX-License-Identifier: MIT
#include "demo/app/settings.h"

#include "common/environment.h"
#include "common/integrator_name.h"
#include "common/progress.h"
#include "common/view.h"
#include "core/base/read_file.h"
#include "io/file/atomic_file.h"
#include "io/file/json_cursor.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <span>
#include <system_error>

namespace zvo::demo
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "zvo.demo_settings/1";
constexpr double kExposureMax = 1000;
constexpr double kDetailMax = 1000; // pixels

const char* modeName(vk::PresentMode mode)
{
    return mode == vk::PresentMode::Fifo ? "fifo" : mode == vk::PresentMode::Mailbox ? "mailbox" : "immediate";
}

View readView(const JsonCursor& value)
{
    const std::string name = value.text();
    const auto views = cli::allViews();
    const auto found = std::ranges::find(views, name, &cli::NamedView::name);
    if (found == views.end())
    {
        throw value.mismatch("the name of a view");
    }
    return found->view;
}

// Calls read with the member of that name, if there is one.
template <typename Read> void with(const JsonCursor& object, const char* name, Read read)
{
    if (const std::optional<JsonCursor> value = object.find(name))
    {
        read(*value);
    }
}

void readViewState(const JsonCursor& object, ViewState& view)
{
    FrameOptions& frame = view.frame;
    object.allowKeys({"view", "integrator", "denoise", "shadows", "occlusion", "sun", "exposure", "detail",
                      "internal_scale", "present"});
    with(object, "view", [&](const JsonCursor& value) { frame.trace.view = readView(value); });
    with(object, "integrator",
         [&](const JsonCursor& value)
         { frame.integrator = static_cast<Integrator>(value.oneOf(cli::kIntegratorNames)); });
    with(object, "denoise", [&](const JsonCursor& value) { frame.denoise = value.flag(); });
    with(object, "shadows", [&](const JsonCursor& value) { frame.trace.shadows = value.flag(); });
    with(object, "occlusion",
         [&](const JsonCursor& value) { frame.trace.occlusion_rays = value.whole(0, kOcclusionRaysMax); });
    with(object, "sun",
         [&](const JsonCursor& value)
         {
             static_cast<void>(value.direction()); // checks that not all numbers are 0; any length is allowed
             frame.trace.to_sun = value.vector();
         });
    with(object, "exposure",
         [&](const JsonCursor& value) { frame.exposure.factor = static_cast<float>(value.positive(kExposureMax)); });
    with(object, "detail",
         [&](const JsonCursor& value) { frame.trace.detail_pixels = static_cast<float>(value.positive(kDetailMax)); });
    with(object, "internal_scale", [&](const JsonCursor& value) { view.internal_scale = value.positive(1); });
    with(object, "present",
         [&](const JsonCursor& value) {
             view.present_mode = static_cast<vk::PresentMode>(value.oneOf({"fifo", "mailbox", "immediate"}));
         });
}

} // namespace

std::optional<std::filesystem::path> settingsFile()
{
    std::filesystem::path base = cli::environmentPath("XDG_CONFIG_HOME");
    if (base.empty())
    {
        base = cli::environmentPath("HOME");
        base = base.empty() ? base : base / ".config";
    }
    return base.empty() ? std::nullopt : std::optional(base / "zvo" / "demo.json");
}

Settings parseSettings(std::string_view text, const std::filesystem::path& file)
{
    const nlohmann::json document = parseJsonStrictly(text, file);
    const JsonCursor object(document, file);
    object.allowKeys({"schema", "window", "panels", "keys", "view"});
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
    with(object, "view", [&](const JsonCursor& value) { readViewState(value, settings.view); });
    return settings;
}

std::string settingsText(const Settings& settings)
{
    const ViewState& view = settings.view;
    const FrameOptions& frame = view.frame;
    const auto views = cli::allViews();
    Json json;
    json["schema"] = kSchema;
    json["window"] = {{"width", settings.window.width}, {"height", settings.window.height}};
    json["panels"] = settings.shows_panels;
    json["keys"] = settings.shows_keys;
    Json& shown = json["view"];
    shown["view"] = std::ranges::find(views, frame.trace.view, &cli::NamedView::view)->name;
    shown["integrator"] = std::string(cli::nameOf(frame.integrator));
    shown["denoise"] = frame.denoise;
    shown["shadows"] = frame.trace.shadows;
    shown["occlusion"] = frame.trace.occlusion_rays;
    shown["sun"] = {frame.trace.to_sun.x, frame.trace.to_sun.y, frame.trace.to_sun.z};
    shown["exposure"] = double{frame.exposure.factor};
    if (frame.trace.detail_pixels > 0.0F)
    {
        shown["detail"] = double{frame.trace.detail_pixels};
    }
    if (view.internal_scale)
    {
        shown["internal_scale"] = *view.internal_scale;
    }
    shown["present"] = modeName(view.present_mode);
    return json.dump(2) + "\n";
}

Settings readSettings(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
    {
        return {};
    }
    try
    {
        const std::vector<std::uint8_t> bytes = readFile(file);
        return parseSettings({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file);
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
