// SPDX-License-Identifier: MIT
#include "options.h"

#include "common/option_groups.h"
#include "common/parse.h"
#include "common/view.h"
#include "zvo/error.h"
#include "zvo/version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::size_t kHelpColumn = 34;

constexpr const char* kMainFooter = R"(
Examples:
  zvo render scenes/atrium.glb -o atrium.png
  zvo voxelize bunny.glb --resolution 256 -o bunny.ply
  zvo build bunny.glb --resolution 2048 -o bunny.zvo
  zvo info
  zvo bench --scenes ../models --resolutions 256,512

'zvo COMMAND --help' tells the options of a command.
Exit codes: 0 success, 2 usage, 3 input, 4 output, 5 no usable device, 6 memory, 1 anything else.)";

constexpr const char* kRenderFooter = R"(
Examples:
  zvo render scenes/atrium.glb -o atrium.png --json atrium.json
  zvo render bunny.glb -o bunny.png --resolution 1024 --view normal
  zvo render room.glb lamp.glb -o room.png --camera 4,2,5,0,1,0,60 --occlusion 16
  zvo render helmet.glb -o 'turn_###.png' --frames 0..35 -f
  zvo render scenes/atrium_knot.scene.json -o 'frame_####.png' --frames 0..119 --structure svdag
  zvo render scenes/atrium.glb -o 'fly_####.png' --camera-path flight.json --frames 0..89
  zvo render scenes/cornell_box.glb -o box.png --integrator path --spp 256
  zvo render bunny.zvo -o bunny.png
  zvo render scenes/sponza_bunny.scene.json -o later.png --scenes ../models --time 1.5)";

constexpr const char* kVoxelizeFooter = R"(
A .morton file holds the sorted Morton codes of the voxels (x in bit 0, y in bit 1, z in bit 2), 64-bit
little-endian integers, and nothing else. A .ply file holds the voxels' centres in world space as points
with normals and sRGB colours.

Examples:
  zvo voxelize bunny.glb -o bunny.morton --resolution 256 --json -
  zvo voxelize part.stl -o part.ply --up z --scale 0.001
  zvo voxelize part.glb -o part.ply --bounds=-1,-1,-1,1,1,1
  zvo voxelize part.glb -o - --format morton --attributes none | sha256sum)";

constexpr const char* kBuildFooter = R"(
A .zvo file holds the tree with its attributes: docs/file-format.md. zvo render shows it, zvo inspect tells what is
in it, zvo convert makes other files of it.

Examples:
  zvo build bunny.glb -o bunny.zvo --resolution 2048
  zvo build town.glb -o town.zvo --resolution 8192 --attributes none --memory-limit 2G)";

constexpr const char* kInspectFooter = R"(
Everything in the file is checked first. Beside the bytes of this file stand those that other trees of the same voxels
take, with nodes of 2x2x2 cells: an octree with 36 bytes a node, and a DAG with 68 bytes a node.

Examples:
  zvo inspect bunny.zvo
  zvo inspect bunny.zvo --json | jq .geometry_bytes_per_voxel)";

constexpr const char* kConvertFooter = R"(
.zvo files hold trees with attributes (docs/file-format.md); .vox files are those of MagicaVoxel, with 255 colours;
.ply files hold voxel centres as points; .morton files sorted Morton codes; .glb files a mesh of the voxels' faces with
vertex colours.

Examples:
  zvo convert bunny.zvo -o bunny.glb
  zvo convert castle.vox -o castle.zvo
  zvo convert bunny.zvo -o - --format morton | sha256sum)";

constexpr const char* kInfoFooter = R"(
Examples:
  zvo info
  zvo info --json | jq '.devices[].missing')";

// The options of pictures by path tracing.
void addPathOptions(CLI::App& render, RenderOptions& options)
{
    addValue(render, "--integrator", options.integrator, integratorOf, kIntegratorTypes, kIntegratorHelp);
    const auto integer = [](std::uint32_t low, std::uint32_t high)
    {
        return [low, high](std::string_view option, std::string_view text)
        { return static_cast<std::uint32_t>(parseInteger(option, text, low, high)); };
    };
    PathRenderOptions& paths = options.paths;
    addValue(render, "--spp", paths.samples, integer(1, 1U << 24), "N",
             fmt::format("paths a pixel, or frames of --integrator cached, 1 to {} (default 64, or 16)", 1U << 24));
    addValue(render, "--bounces", paths.path.bounces, integer(0, kBouncesMax), "N",
             fmt::format("diffuse reflections of a path, 0 to {} (default 8)", kBouncesMax));
    addValue(render, "--seed", paths.path.seed, integer(0, UINT32_MAX), "N",
             fmt::format("of the paths' random numbers, 0 to {} (default 0)", UINT32_MAX));
    KeptRenderOptions& kept = options.kept;
    addValue(render, "--settle", kept.settle, integer(0, 1U << 24), "N",
             fmt::format("frames of --integrator cached before the first picture, 0 to {} (default 64)", 1U << 24));
    addValue(render, "--rays", kept.radiance.faces, integer(1, kRadianceFacesMax), "N",
             fmt::format("faces that a frame of --integrator cached samples at most, 1 to {} (default 16384): each "
                         "takes up to two rays and two shadow rays",
                         kRadianceFacesMax));
    addValue(render, "--aperture", paths.path.lens_radius, parsePositive, "RADIUS",
             "radius of the lens of the camera, in world units (default: a pinhole)");
    addValue(render, "--focus", paths.path.focus_distance, parsePositive, "DISTANCE",
             "distance of the plane that is in focus, in world units (default 1)");
    addValue(
        render, "--environment", paths.environment,
        [](std::string_view, const std::string& text) { return std::filesystem::path(text); }, "FILE",
        "a map of the light from all directions, .hdr or .exr, in place of sun and sky, or none for no light; --sun "
        "adds "
        "the sun");
    addValue(render, "--environment-turn", paths.environment_turn, parseDegrees, "DEGREES",
             "turns the map about the vertical, counterclockwise from above (default 0)");
    addValue(render, "--environment-strength", paths.environment_strength, parsePositive, "FACTOR",
             "factor for the map's light (default 1)");
    render.add_flag("--denoise", paths.denoise,
                    "smooth the noise of few paths, but not edges; in sequences with the help of earlier pictures");
    render.add_flag("--aov", paths.aovs,
                    "write albedo, normal, depth and motion as channels of the picture, which must be an .exr");
    addValue(
        render, "--path-form", paths.form,
        [](std::string_view option, std::string_view text) {
            return oneOf(option, text, {"stages", "kernel"}) == "kernel" ? PathForm::OneKernel : PathForm::Stages;
        },
        "stages|kernel",
        "paths advance together, or one kernel follows each to its end; the picture is the same (default: as is faster "
        "on the device)");
    addValue(render, "--time-limit", paths.time_limit, parseSeconds, "SECONDS",
             "begin no more paths after this time; the picture shows those that were traced");
}

CLI::App* addRender(CLI::App& app, RenderOptions& options)
{
    CLI::App* render = app.add_subcommand("render", "voxelize scenes, or load a tree, and ray trace a picture");
    addVoxelOptions(*render, options.voxels, "; or one .zvo file, which needs no voxelizing");
    addAttributesOption(*render, options.voxels.attributes);
    render
        ->add_option_function<std::string>(
            "--size",
            [&options](const std::string& text)
            { std::tie(options.width, options.height) = parseSize("--size", text); },
            "pixels of the picture (default 1280x720)")
        ->type_name("WxH");
    addCameraOption(*render, options.camera);
    addValue(
        *render, "--camera-path", options.camera_path,
        [](std::string_view, const std::string& text) { return std::filesystem::path(text); }, "FILE",
        "a camera that flies along the keys in a JSON file; of --frames, frame N at N / frames_per_second seconds, or "
        "at --time")
        ->excludes("--camera");
    addValue(*render, "--view", options.view, viewOf, "VIEW", viewHelp());
    addValue(
        *render, "--occlusion", options.occlusion_rays,
        [](std::string_view option, std::string_view text)
        { return static_cast<std::uint32_t>(parseInteger(option, text, 0, kOcclusionRaysMax)); },
        "RAYS",
        fmt::format("rays a pixel that find how much of the sky it sees, 0 to {} (default 0)", kOcclusionRaysMax));
    addValue(*render, "--sun", options.to_sun, parseDirection, "x,y,z",
             "direction to the sun (default -0.6,0.75,0.45)");
    addPathOptions(*render, options);
    addValue(*render, "--exposure", options.exposure, parsePositive, "FACTOR",
             "brightness of the picture (default 1; for paths, so that it is neither dark nor bright)");
    addValue(*render, "--detail", options.detail_pixels, parsePositive, "PIXELS",
             "rays stop at octree nodes up to this many pixels wide (default: they go on to voxels)");
    addValue(*render, "--frames", options.frames, parseFrames, "A..B",
             "pictures of a scene in which something moves, frame N at N / frames_per_second seconds; of any other "
             "scene, a camera that turns once around it; #### in the output's name becomes the frame's number")
        ->excludes("--time");
    addValue(
        *render, "--structure", options.structure, parseStructure, "svo|svdag",
        "trace an octree, or a DAG, which has equal subtrees once; what moves is merged with either (default svo)");
    render->add_flag("--rebuild", options.rebuild,
                     "voxelize everything anew for each picture of a scene in which something moves, instead of "
                     "merging what moves with what stands still");
    addOutputOptions(*render, options.output,
                     "the picture, a .png file, or of paths an .exr or .hdr file; - is standard output, of a .png");
    addDeviceOptions(*render, options.device);
    render->footer(kRenderFooter);
    return render;
}

CLI::App* addVoxelize(CLI::App& app, VoxelizeOptions& options)
{
    CLI::App* voxelize = app.add_subcommand("voxelize", "voxelize scenes and write the voxels");
    addVoxelOptions(*voxelize, options.voxels);
    addAttributesOption(*voxelize, options.voxels.attributes);
    addOutputOptions(*voxelize, options.output, "the voxels, a .morton or .ply file; - is standard output");
    addValue(
        *voxelize, "--format", options.format,
        [](std::string_view option, std::string_view text) {
            return oneOf(option, text, {"morton", "ply"});
        },
        "morton|ply", "what to write (default: as the output's extension says)")
        ->group("Output");
    addDeviceOptions(*voxelize, options.device);
    voxelize->footer(kVoxelizeFooter);
    return voxelize;
}

CLI::App* addBuild(CLI::App& app, BuildFileOptions& options)
{
    CLI::App* build = app.add_subcommand("build", "voxelize scenes and write the tree to a .zvo file");
    addVoxelOptions(*build, options.voxels);
    addStructureOption(*build, options.structure);
    addValue(*build, "--attributes", options.voxels.attributes, parseAttributeFormat, "none|4|8|block",
             "colour, normal and emission of the voxels: colour and normal in 4 or 8 bytes or in blocks of 16, "
             "which take 24; or only their places (default 8)");
    addOutputOptions(*build, options.output, "the tree, a .zvo file; - is standard output");
    addDeviceOptions(*build, options.device);
    build->footer(kBuildFooter);
    return build;
}

CLI::App* addInspect(CLI::App& app, InspectOptions& options)
{
    CLI::App* inspect = app.add_subcommand("inspect", "tell what is in a .zvo file");
    inspect->add_option("FILE", options.file, "a .zvo file")->required()->type_name("FILE");
    inspect->add_flag("--json", options.json, "as JSON");
    inspect->footer(kInspectFooter);
    return inspect;
}

CLI::App* addValidate(CLI::App& app, ValidateOptions& options)
{
    CLI::App* validate = app.add_subcommand("validate", "check everything in a .zvo file");
    validate->add_option("FILE", options.file, "a .zvo file")->required()->type_name("FILE");
    validate->footer("\nThe exit code is 0 for a sound file, and 3, with the first fault, for any other.");
    return validate;
}

CLI::App* addConvert(CLI::App& app, ConvertOptions& options)
{
    CLI::App* convert = app.add_subcommand("convert", "make another kind of file of a .zvo or .vox file");
    convert->add_option("FILE", options.file, "a .zvo or .vox file")->required()->type_name("FILE");
    addStructureOption(*convert, options.structure);
    addText(*convert, "-o,--output", options.output.path, "FILE",
            "a .ply, .vox, .morton, .glb, .nvdb or .zvo file; - is standard output")
        ->required()
        ->group("Output");
    convert->add_flag("-f,--force", options.output.overwrite, "overwrite a file that exists")->group("Output");
    addValue(
        *convert, "--format", options.format,
        [](std::string_view option, std::string_view text) {
            return oneOf(option, text, {"ply", "vox", "morton", "glb", "nvdb", "zvo"});
        },
        "FORMAT", "what to write: ply, vox, morton, glb, nvdb or zvo (default: as the output's extension says)")
        ->group("Output");
    addDeviceOptions(*convert, options.device);
    convert->footer(kConvertFooter);
    return convert;
}

CLI::App* addInfo(CLI::App& app, InfoOptions& options)
{
    CLI::App* info = app.add_subcommand("info", "list the Vulkan devices and what they offer");
    info->add_flag("--json", options.json, "as JSON");
    addText(*info, "--device", options.device, "NAME", "which device would be used for this choice");
    info->footer(kInfoFooter);
    return info;
}

// Names the arguments that no option has taken.
std::string strangerText(const CLI::App& app)
{
    const std::vector<std::string> strangers = app.remaining(true);
    const char* const what = app.get_subcommands().empty() ? "there is no command or option" : "not understood:";
    return fmt::format("{} {}", what, fmt::join(strangers, " "));
}

Error usageError(const CLI::App& app, std::string what)
{
    const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
    const std::string name = command == &app ? "zvo" : "zvo " + command->get_name();
    while (!what.empty() && (what.back() == '\n' || what.back() == '.'))
    {
        what.pop_back();
    }
    return {ErrorCode::Usage, fmt::format("{}; see {} --help", what, name)};
}

// Reads the arguments. Returns the text that --help or --version asks for, or nothing.
std::optional<std::string> parse(CLI::App& app, int argc, const char* const* argv)
{
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::CallForHelp&)
    {
        return app.help();
    }
    catch (const CLI::CallForVersion& version)
    {
        return std::string(version.what()) + "\n";
    }
    catch (const CLI::ExtrasError&)
    {
        throw usageError(app, strangerText(app));
    }
    catch (const CLI::ParseError& error)
    {
        throw usageError(app, error.what());
    }
    catch (const Error& error)
    {
        throw usageError(app, error.what());
    }
    if (app.get_subcommands().empty())
    {
        throw usageError(app,
                         "a command is missing: render, voxelize, build, inspect, validate, convert, info or bench");
    }
    return std::nullopt;
}

} // namespace

Command parseCommandLine(int argc, const char* const* argv)
{
    CLI::App app("zvo turns triangle scenes into sparse voxel octrees on the GPU and ray traces them.", "zvo");
    app.get_formatter()->column_width(kHelpColumn);
    app.footer(kMainFooter);
    app.set_version_flag("--version", "zvo " ZVO_VERSION_TEXT, "print the version");
    RenderOptions render;
    VoxelizeOptions voxelize;
    BuildFileOptions build;
    InspectOptions inspect;
    ValidateOptions validate;
    ConvertOptions convert;
    InfoOptions info;
    BenchOptions bench;
    const CLI::App* const render_app = addRender(app, render);
    const CLI::App* const voxelize_app = addVoxelize(app, voxelize);
    const CLI::App* const build_app = addBuild(app, build);
    const CLI::App* const inspect_app = addInspect(app, inspect);
    const CLI::App* const validate_app = addValidate(app, validate);
    const CLI::App* const convert_app = addConvert(app, convert);
    const CLI::App* const info_app = addInfo(app, info);
    const CLI::App* const bench_app = addBench(app, bench);
    if (const std::optional<std::string> text = parse(app, argc, argv))
    {
        return *text;
    }
    if (bench.dynamic && bench.scenes.empty())
    {
        throw usageError(app, "--dynamic needs a scene file (.scene.json) or another scene in which something moves");
    }
    if (bench_app->count("--structure") != 0 && !bench.dynamic && !bench.edit)
    {
        throw usageError(app, "--structure needs --dynamic or --edit");
    }
    for (const VoxelOptions* options : {&render.voxels, &voxelize.voxels, &build.voxels})
    {
        if (options->bounds && options->grid_position)
        {
            throw usageError(app, "--bounds and --grid exclude each other");
        }
    }
    const std::pair<const CLI::App*, Command> commands[] = {
        {render_app, render},     {voxelize_app, voxelize}, {build_app, build}, {inspect_app, inspect},
        {validate_app, validate}, {convert_app, convert},   {info_app, info},   {bench_app, bench}};
    return std::ranges::find(commands, app.get_subcommands().front(), [](const auto& command) { return command.first; })
        ->second;
}

} // namespace zvo::cli
