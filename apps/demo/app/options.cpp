// SPDX-License-Identifier: MIT
#include "demo/app/options.h"

#include "common/command_line.h"
#include "common/option_groups.h"
#include "common/output.h"
#include "common/parse.h"
#include "zvo/error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::demo
{

namespace
{

constexpr std::uint32_t kFramesInFlightMax = 4;
constexpr double kStepMax = 10; // seconds

constexpr const char* kFooter = R"(
F1 lists the keys. Files dropped onto the window replace what it shows. Settings are kept in
$XDG_CONFIG_HOME/zvo/demo.json, or ~/.config/zvo/demo.json, but for runs with --frames.

Examples:
  zvo-demo scenes/atrium.glb --resolution 256
  zvo-demo scenes/atrium_knot.scene.json --structure svdag
  zvo-demo bunny.zvo --view iterations --present immediate
  zvo-demo scenes/atrium.glb --frames 60 --fixed-step 1/60 --hide-ui --screenshot last.png --json stats.json

Exit codes: 0 success, 2 usage, 3 input, 4 output, 5 no usable device or no display, 6 memory, 1 anything else.)";

// Parses seconds: "0.02" or "1/60".
FixedStep parseStep(std::string_view option, std::string_view text)
{
    const std::size_t slash = text.find('/');
    FixedStep step = {1, 1};
    step.numerator = double{cli::parsePositive(option, text.substr(0, slash))};
    if (slash != std::string_view::npos)
    {
        step.denominator = double{cli::parsePositive(option, text.substr(slash + 1))};
    }
    if (step.seconds() > kStepMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} {}: expected at most {} seconds", option, text, kStepMax));
    }
    return step;
}

PictureSize parsePictureSize(std::string_view option, std::string_view text)
{
    const auto [width, height] = cli::parseSize(option, text);
    return {width, height};
}

// Adds the options of the settings, each to the group that it names.
void addSettings(CLI::App& app, DemoOptions& options)
{
    for (const ViewSetting& setting : viewSettings())
    {
        const std::string name = setting.optionName();
        const auto change = [&options, &setting, name](const std::string& argument)
        { options.view_changes.push_back(setting.parse(name, argument)); };
        const ViewSetting::Option& option = setting.option;
        if (option.group != nullptr)
        {
            (option.type.empty() ? app.add_flag_callback(
                                       name, [change] { change(""); }, option.help)
                                 : app.add_option_function<std::string>(name, change, option.help))
                ->type_name(option.type)
                ->group(option.group);
        }
    }
}

void addViewOptions(CLI::App& app, DemoOptions& options)
{
    constexpr const char* kGroup = "View";
    cli::addCameraOption(app, options.camera);
    cli::addValue(app, "--camera-path", options.camera_path, cli::parsePath, "FILE",
                  "fly along the cameras of a file, as zvo render does")
        ->group(kGroup);
    cli::addTimeOfDayOption(
        app, [&options](const glm::dvec3& to_sun)
        { options.view_changes.emplace_back([to_sun](ViewState& view) { view.frame.trace.to_sun = to_sun; }); });
    cli::addEnvironmentOptions(app, options.environment, "; --map-sun adds the sun");
    for (const char* const name : {"--camera", "--time-of-day", "--environment", "--environment-turn",
                                   "--environment-strength", "--background-blur"})
    {
        app.get_option(name)->group(kGroup);
    }
}

void addWindowOptions(CLI::App& app, DemoOptions& options)
{
    constexpr const char* kGroup = "Window";
    cli::addValue(app, "--size", options.size, parsePictureSize, "WxH", "of the window (default 1280x720)")
        ->group(kGroup);
    addSettings(app, options);
    cli::addValue(app, "--frames-in-flight", options.frames_in_flight, cli::integerIn(1, kFramesInFlightMax), "N",
                  "frames that are under way at once, 1 to 4 (default 2)")
        ->group(kGroup);
    cli::addFolder(app, "--shaders", options.shaders,
                   "sources of the shaders that F5 compiles (default: those that were installed with the program, or "
                   "else that it was built from)");
    app.get_option("--shaders")->group(kGroup);
    app.add_flag("--hide-ui", options.hide_ui, "without panels; H shows them")->group(kGroup);
}

void addScriptOptions(CLI::App& app, DemoOptions& options)
{
    constexpr const char* kGroup = "Scripts";
    constexpr std::uint32_t kFramesMax = 1'000'000'000;
    cli::addValue(app, "--frames", options.frame_count, cli::integerIn(1, kFramesMax), "N", "end after so many frames")
        ->group(kGroup);
    cli::addValue(app, "--fixed-step", options.fixed_step, parseStep, "SECONDS",
                  "time that a frame takes, such as 1/60, whatever the clock says: every run shows the same")
        ->group(kGroup);
    cli::addValue(app, "--input-script", options.input_script, cli::parsePath, "FILE",
                  "input events to play, in place of the user's")
        ->group(kGroup);
    cli::addValue(app, "--record-input", options.record_input, cli::parsePath, "FILE", "write the user's input events")
        ->group(kGroup);
    cli::addOutput(app, "--screenshot", options.screenshot, "FILE", "write the last frame of --frames as a PNG file")
        ->group(kGroup);
    cli::addOutput(app, "--json", options.json, "FILE|-", "write statistics; - is standard output")->group(kGroup);
    app.add_flag("-f,--force", options.overwrite, "overwrite files that exist")->group(kGroup);
}

void check(const CLI::App& app, const DemoOptions& options)
{
    if (!options.screenshot.empty() && !options.frame_count)
    {
        throw cli::usageError(app, "--screenshot needs --frames, whose last one it shows");
    }
    if (options.screenshot == "-")
    {
        throw cli::usageError(app, "--screenshot needs a file's name");
    }
    if (!options.screenshot.empty())
    {
        cli::checkPictureName("--screenshot", options.screenshot);
    }
    std::vector<std::filesystem::path> inputs = options.voxels.scenes;
    for (const std::optional<std::filesystem::path>& input :
         {options.input_script, options.camera_path, options.environment.map})
    {
        if (input)
        {
            inputs.push_back(*input);
        }
    }
    cli::checkOutputs(std::array{options.screenshot, options.json, options.record_input.value_or("").string()}, inputs);
}

} // namespace

std::optional<DemoOptions> parseCommandLine(int argc, const char* const* argv)
{
    CLI::App app("zvo-demo shows triangle scenes, and trees, as voxels in a window.", "zvo-demo");
    cli::describeProgram(app, kFooter);
    DemoOptions options;
    cli::addVoxelOptions(app, options.voxels, "; or one .zvo or .vox file");
    app.get_option("SCENE")->required(false);
    cli::addFillOption(app, options.voxels.fill);
    cli::addAttributesOption(app, options.voxels.attributes);
    cli::addStructureOption(app, options.structure, "what stands still is an octree or a DAG (default svo)");
    addViewOptions(app, options);
    addWindowOptions(app, options);
    app.get_option("--time-of-day")->excludes("--sun");
    addScriptOptions(app, options);
    cli::addDeviceOptions(app, options.device);
    if (!cli::parse(app, argc, argv))
    {
        return std::nullopt;
    }
    check(app, options);
    return options;
}

} // namespace zvo::demo
