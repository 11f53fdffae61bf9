// SPDX-License-Identifier: MIT
#include "demo/app/view_settings.h"

#include "common/names.h"
#include "common/parse.h"
#include "common/view.h"
#include "demo/app/view_controls.h"
#include "demo/panels/panel_text.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace zvo::demo
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* kViewGroup = "View";
constexpr const char* kWindowGroup = "Window";

// How values are read from an option and from the settings' file, and written to the file.
template <typename T> struct Form
{
    std::function<T(std::string_view option, const std::string& argument)> parse;
    std::function<T(const JsonCursor& value)> read;
    std::function<Json(const T& value)> write = [](const T& value) { return Json(value); };
};

// expected: in errors of the file; empty: the names.
template <typename T, std::size_t count>
Form<T> named(const cli::Names<T, count>& names, std::string_view expected = {})
{
    return {[&names](std::string_view option, const std::string& argument)
            { return cli::parseNamed(option, argument, names); },
            [&names, expected](const JsonCursor& value)
            {
                const auto found = cli::findNamed(names, value.isText() ? value.text() : "");
                if (found == names.end())
                {
                    throw value.mismatch(expected.empty() ? "one of " + cli::listOf(names) : std::string(expected));
                }
                return found->value;
            },
            [&names](const T& value) { return Json(cli::nameOf(names, value)); }};
}

Form<bool> flag()
{
    return {[](std::string_view, const std::string&) { return true; },
            [](const JsonCursor& value) { return value.flag(); }};
}

Form<std::uint32_t> wholeUpTo(std::uint32_t most)
{
    return {cli::integerIn(0, most), [most](const JsonCursor& value) { return value.whole(0, most); }};
}

// An option's number above 0 and at most `most`.
float parseUpTo(double most, std::string_view option, const std::string& argument)
{
    const float number = cli::parsePositive(option, argument);
    if (double{number} > most)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} {}: expected a number above 0 and at most {}", option, argument, most));
    }
    return number;
}

// A number above 0; in the file, 0 is left out.
Form<float> positive()
{
    return {std::bind_front(parseUpTo, ViewState::kPositiveMax),
            [](const JsonCursor& value) { return static_cast<float>(value.positive(ViewState::kPositiveMax)); },
            [](float value) { return value > 0.0F ? Json(double{value}) : Json(); }};
}

// Of an option it is that of every picture, as of zvo render. Kept is only a factor beside the automatic one.
Form<Exposure> exposure()
{
    return {[](std::string_view option, const std::string& argument)
            { return Exposure{.automatic = false, .factor = parseUpTo(ViewState::kPositiveMax, option, argument)}; },
            [](const JsonCursor& value) { return Exposure{.factor = positive().read(value)}; },
            [](const Exposure& value) { return value.automatic ? Json(double{value.factor}) : Json(); }};
}

// A factor above 0 and at most 1, or nothing.
Form<std::optional<double>> scale()
{
    return {std::bind_front(parseUpTo, 1.0), [](const JsonCursor& value) { return std::optional(value.positive(1)); },
            [](const std::optional<double>& factor) { return factor ? Json(*factor) : Json(); }};
}

// Belongs to a scene's size, so that it is not kept for others.
Form<float> ofScene()
{
    return {cli::parsePositive,
            [](const JsonCursor& value) { return static_cast<float>(value.positive(ViewState::kPositiveMax)); },
            [](float) { return Json(); }};
}

// Of any length, but not 0.
Form<glm::dvec3> direction()
{
    return {cli::parseDirection, [](const JsonCursor& value) { return value.nonZeroVector(); },
            [](const glm::dvec3& value) {
                return Json{value.x, value.y, value.z};
            }};
}

// In which pictures a setting has an effect.
bool always(const ViewState&)
{
    return true;
}

bool withLight(const ViewState& view)
{
    return view.frame.trace.view == View::Color;
}

bool byPrimaryRays(const ViewState& view)
{
    return view.frame.shownIntegrator() == Integrator::Primary;
}

bool byLitPrimaryRays(const ViewState& view)
{
    return withLight(view) && byPrimaryRays(view);
}

bool byPaths(const ViewState& view)
{
    return view.frame.shownIntegrator() == Integrator::Path;
}

bool byNormalsOrFaces(const ViewState& view)
{
    return withLight(view) && view.frame.integrator != Integrator::Cones;
}

bool byPathsThroughALens(const ViewState& view)
{
    return byPaths(view) && view.frame.path.lens_radius > 0;
}

// of: the setting's place in a ViewState.
template <typename T, typename Of>
ViewSetting setting(const char* key, const Of& of, const Form<T>& form, ViewSetting::Option option,
                    void (*show)(ViewState&, const ViewInfo&), bool (*applies)(const ViewState&) = always)
{
    const auto parse = [=](std::string_view name, const std::string& argument) -> ViewChange
    { return [of, value = form.parse(name, argument)](ViewState& view) { of(view) = value; }; };
    return {key,
            std::move(option),
            parse,
            [=](ViewState& view, const JsonCursor& value) { of(view) = form.read(value); },
            [=](const ViewState& view) { return form.write(of(view)); },
            show,
            applies};
}

std::vector<ViewSetting> makeSettings()
{
    return {
        setting(
            "view", [](auto& view) -> auto& { return view.frame.trace.view; }, named(cli::kViews, "the name of a view"),
            {kViewGroup, "VIEW", cli::viewHelp()}, showView),
        setting(
            "integrator", [](auto& view) -> auto& { return view.frame.integrator; }, named(cli::kIntegrators),
            {kViewGroup, cli::listOf(cli::kIntegrators, "|"), cli::kIntegratorHelp}, showIntegrator, withLight),
        setting(
            "shading", [](auto& view) -> auto& { return view.frame.shading; }, named(cli::kShadings),
            {kViewGroup, cli::listOf(cli::kShadings, "|"), cli::kShadingHelp}, showShading, byNormalsOrFaces),
        setting(
            "denoise", [](auto& view) -> auto& { return view.frame.denoise; }, flag(),
            {kViewGroup, "", "smooth the noise of few paths, but not edges"}, showDenoise, byPaths),
        setting(
            "shadows", [](auto& view) -> auto& { return view.frame.trace.shadows; }, flag(), {}, showShadows,
            withLight),
        setting(
            "occlusion", [](auto& view) -> auto& { return view.frame.trace.occlusion_rays; },
            wholeUpTo(kOcclusionRaysMax),
            {kViewGroup, "RAYS", "rays a sample that find how much of the sky it sees (default 4)"}, showOcclusion,
            byLitPrimaryRays),
        setting(
            "sun", [](auto& view) -> auto& { return view.frame.trace.to_sun; }, direction(),
            {kViewGroup, "x,y,z", "direction to the sun"}, showSun, withLight),
        setting(
            "map_sun", [](auto& view) -> auto& { return view.map_sun; }, flag(),
            {kViewGroup, "", "a sun beside the map of --environment"}, nullptr),
        setting(
            "bounces", [](auto& view) -> auto& { return view.frame.path.bounces; }, wholeUpTo(kBouncesMax),
            {kViewGroup, "N", "diffuse reflections of a path (default 8)"}, showBounces, byPaths),
        setting(
            "aperture", [](auto& view) -> auto& { return view.frame.path.lens_radius; }, ofScene(),
            {kViewGroup, "RADIUS", "of the lens of paths, in world units (default: a pinhole)"}, showAperture, byPaths),
        setting(
            "focus", [](auto& view) -> auto& { return view.frame.path.focus_distance; }, ofScene(),
            {kViewGroup, "DISTANCE", "of the plane in focus, in world units (default 1)"}, showFocus,
            byPathsThroughALens),
        setting(
            "exposure", [](auto& view) -> auto& { return view.frame.exposure; }, exposure(),
            {kViewGroup, "FACTOR", "brightness (default: automatic, times the panel's factor)"}, showExposure,
            withLight),
        setting(
            "detail", [](auto& view) -> auto& { return view.frame.trace.detail_pixels; }, positive(),
            {kViewGroup, "PIXELS", "rays stop at octree nodes up to this many pixels wide"}, showDetail, byPrimaryRays),
        setting(
            "internal_scale", [](auto& view) -> auto& { return view.internal_scale; }, scale(),
            {kWindowGroup, "FACTOR",
             "trace pictures with edges this part of the window's, above 0 to 1 (default 1; while things move, on CPU "
             "devices, whatever is fast)"},
            showResolution),
        setting(
            "present", [](auto& view) -> auto& { return view.present_mode; }, named(cli::kPresentModes),
            {kWindowGroup, cli::listOf(cli::kPresentModes, "|"), "how pictures wait for the screen (default fifo)"},
            showPresentMode),
    };
}

} // namespace

std::string ViewSetting::optionName() const
{
    std::string name = "--" + key;
    std::ranges::replace(name, '_', '-');
    return name;
}

const std::vector<ViewSetting>& viewSettings()
{
    static const std::vector<ViewSetting> settings = makeSettings();
    return settings;
}

void viewPanel(ViewState& view, const ViewInfo& info)
{
    if (!ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen))
    {
        return;
    }
    for (const ViewSetting& setting : viewSettings())
    {
        if (setting.show != nullptr && setting.applies(view))
        {
            setting.show(view, info);
        }
    }
    tell(fmt::format("flies {:.3g} units/s", info.camera_speed));
}

} // namespace zvo::demo
