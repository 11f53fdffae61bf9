// SPDX-License-Identifier: MIT
#include "demo/app/options.h"

#include "common/command_line.h"
#include "common/integrator_name.h"
#include "common/option_groups.h"
#include "common/output.h"
#include "common/parse.h"
#include "common/view.h"
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

double parseScale(std::string_view option, std::string_view text)
{
    const float scale = cli::parsePositive(option, text);
    if (scale > 1.0F)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} {}: expected a number above 0 and at most 1", option, text));
    }
    return double{scale};
}

vk::PresentMode parsePresentMode(std::string_view option, std::string_view text)
{
    const std::string name = cli::oneOf(option, text, {"fifo", "mailbox", "immediate"});
    return name == "fifo"      ? vk::PresentMode::Fifo
           : name == "mailbox" ? vk::PresentMode::Mailbox
                               : vk::PresentMode::Immediate;
}

PictureSize parsePictureSize(std::string_view option, std::string_view text)
{
    const auto [width, height] = cli::parseSize(option, text);
    return {width, height};
}

template <std::uint32_t low, std::uint32_t high>
std::uint32_t parseCount(std::string_view option, std::string_view text)
{
    return static_cast<std::uint32_t>(cli::parseInteger(option, text, low, high));
}

std::filesystem::path parsePath(std::string_view, const std::string& text)
{
    return text;
}

void addViewOptions(CLI::App& app, DemoOptions& options)
{
    constexpr const char* kGroup = "View";
    cli::addCameraOption(app, options.camera);
    app.get_option("--camera")->group(kGroup);
    cli::addValue(app, "--camera-path", options.camera_path, parsePath, "FILE",
                  "fly along the cameras of a file, as zvo render does")
        ->group(kGroup);
    cli::addValue(app, "--view", options.view, cli::viewOf, "VIEW", cli::viewHelp())->group(kGroup);
    cli::addValue(app, "--integrator", options.integrator, cli::integratorOf, cli::kIntegratorTypes,
                  cli::kIntegratorHelp)
        ->group(kGroup);
    app.add_flag("--denoise", options.denoise, "smooth the noise of few paths, but not edges")->group(kGroup);
    cli::addValue(app, "--occlusion", options.occlusion_rays, parseCount<0, kOcclusionRaysMax>, "RAYS",
                  "rays a pixel that find how much of the sky it sees (default 0)")
        ->group(kGroup);
    cli::addValue(app, "--sun", options.to_sun, cli::parseDirection, "x,y,z", "direction to the sun")->group(kGroup);
    cli::addValue(app, "--exposure", options.exposure, cli::parsePositive, "FACTOR", "brightness (default 1)")
        ->group(kGroup);
    cli::addValue(app, "--detail", options.detail_pixels, cli::parsePositive, "PIXELS",
                  "rays stop at octree nodes up to this many pixels wide")
        ->group(kGroup);
}

void addWindowOptions(CLI::App& app, DemoOptions& options)
{
    constexpr const char* kGroup = "Window";
    cli::addValue(app, "--size", options.size, parsePictureSize, "WxH", "of the window (default 1280x720)")
        ->group(kGroup);
    cli::addValue(app, "--internal-scale", options.internal_scale, parseScale, "FACTOR",
                  "trace pictures this much smaller than the window (default 1; on CPU devices whatever is fast)")
        ->group(kGroup);
    cli::addValue(app, "--present", options.present_mode, parsePresentMode, "fifo|mailbox|immediate",
                  "how pictures wait for the screen (default fifo)")
        ->group(kGroup);
    cli::addValue(app, "--frames-in-flight", options.frames_in_flight, parseCount<1, kFramesInFlightMax>, "N",
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
    constexpr std::uint64_t kFramesMax = 1'000'000'000;
    cli::addValue(
        app, "--frames", options.frame_count,
        [](std::string_view option, std::string_view text) { return cli::parseInteger(option, text, 1, kFramesMax); },
        "N", "end after so many frames")
        ->group(kGroup);
    cli::addValue(app, "--fixed-step", options.fixed_step, parseStep, "SECONDS",
                  "time that a frame takes, such as 1/60, whatever the clock says: every run shows the same")
        ->group(kGroup);
    cli::addValue(app, "--input-script", options.input_script, parsePath, "FILE",
                  "input events to play, in place of the user's")
        ->group(kGroup);
    cli::addValue(app, "--record-input", options.record_input, parsePath, "FILE", "write the user's input events")
        ->group(kGroup);
    cli::addText(app, "--screenshot", options.screenshot, "FILE", "write the last frame of --frames as a PNG file")
        ->group(kGroup);
    cli::addText(app, "--json", options.json, "FILE|-", "write statistics; - is standard output")->group(kGroup);
    app.add_flag("-f,--force", options.overwrite, "overwrite files that exist")->group(kGroup);
}

void check(const CLI::App& app, const DemoOptions& options)
{
    if (options.voxels.bounds && options.voxels.grid_position)
    {
        throw cli::usageError(app, "--bounds and --grid exclude each other");
    }
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
    for (const std::optional<std::filesystem::path>& input : {options.input_script, options.camera_path})
    {
        if (input)
        {
            inputs.push_back(*input);
        }
    }
    cli::checkOutputs(std::array{options.screenshot, options.json, options.record_input.value_or("").string()}, inputs);
}

} // namespace

std::variant<std::string, DemoOptions> parseCommandLine(int argc, const char* const* argv)
{
    CLI::App app("zvo-demo shows triangle scenes, and trees, as voxels in a window.", "zvo-demo");
    cli::describeProgram(app, kFooter);
    DemoOptions options;
    cli::addVoxelOptions(app, options.voxels, "; or one .zvo or .vox file");
    app.get_option("SCENE")->required(false);
    cli::addAttributesOption(app, options.voxels.attributes);
    cli::addValue(app, "--structure", options.structure, cli::parseStructure, "svo|svdag",
                  "what stands still is an octree or a DAG (default svo)");
    addViewOptions(app, options);
    addWindowOptions(app, options);
    addScriptOptions(app, options);
    cli::addDeviceOptions(app, options.device);
    if (const std::optional<std::string> text = cli::parse(app, argc, argv))
    {
        return *text;
    }
    check(app, options);
    return options;
}

} // namespace zvo::demo
