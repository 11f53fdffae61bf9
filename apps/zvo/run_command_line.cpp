// SPDX-License-Identifier: MIT
#include "run_command_line.h"

#include "commands.h"
#include "common/command_line.h"
#include "common/option_groups.h"
#include "common/output.h"
#include "common/parse.h"
#include "common/progress.h"
#include "common/run_program.h"
#include "common/view.h"
#include "core/distance/distance_builder.h"
#include "zvo/error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr const char* kMainFooter = R"(
Examples:
  zvo render scenes/atrium.glb -o atrium.png
  zvo voxelize bunny.glb --resolution 256 -o bunny.ply
  zvo build bunny.glb --resolution 2048 -o bunny.zvo
  zvo query bunny.zvo --nearest points.csv -o distances.csv
  zvo info

'zvo help COMMAND' tells the options of a command.
Exit codes: 0 success, 2 usage, 3 input, 4 output, 5 no usable device, 6 memory, 1 anything else.)";

constexpr const char* kRenderFooter = R"(
Examples:
  zvo render scenes/atrium.glb -o atrium.png --json atrium.json
  zvo render bunny.glb -o bunny.png --resolution 1024 --view normal
  zvo render room.glb lamp.glb -o room.png --camera 4,2,5,0,1,0,60 --occlusion 16
  zvo render helmet.glb -o turn.webp --turntable 36 -f
  zvo render helmet.glb -o sheet.png --sheet front,right,top,iso
  zvo render scenes/atrium_knot.scene.json -o 'frame_####.png' --frames 0..119 --structure svdag
  zvo render scenes/atrium.glb -o 'fly_####.png' --camera-path flight.json --frames 0..89
  zvo render scenes/cornell_box.glb -o box.png --integrator path --spp 256
  zvo render bunny.zvo -o bunny.png
  zvo render castle.vox -o castle.png
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
  zvo inspect castle.vox
  zvo inspect bunny.zvo --json | jq .geometry_bytes_per_voxel)";

constexpr const char* kValidateFooter =
    "\nThe exit code is 0 for a sound file, and 3, with the first fault, for any other.";

constexpr const char* kConvertFooter = R"(
.zvo files hold trees with attributes (docs/file-format.md); .vox files are those of MagicaVoxel, with 255 colours;
.ply files hold voxel centres as points; .morton files sorted Morton codes; .glb files a mesh of the voxels' faces with
vertex colours.

Examples:
  zvo convert bunny.zvo -o bunny.glb
  zvo convert castle.vox -o castle.zvo
  zvo convert bunny.zvo -o - --format morton | sha256sum)";

constexpr const char* kEditFooter = R"(
Examples:
  zvo build dragon.glb -o dragon.zvo --fill solid
  zvo edit dragon.zvo cut.json -o cut.zvo
where cut.json is
  {"schema": "zvo.edits/1", "edits": [
    {"action": "carve", "mesh": {"file": "wedge.obj", "place": {"translation": [0, 1, 0]}}},
    {"action": "paint", "sphere": {"centre": [0, 2, 0], "radius": 0.5}, "color": "#c02010"}]})";

constexpr const char* kAlgebraFooter = R"(
Steps are carried out in the order in which they stand; docs/algebra.md. Trees that are combined have the same grid:
build them with the same --resolution and --bounds.

Examples:
  zvo algebra scan.zvo --keep-largest 1 --close 2 --enclose -o part.zvo
  zvo algebra room.zvo --unite chair.zvo --subtract door.zvo -o furnished.zvo
  zvo algebra scan.zvo --components sizes.csv)";

constexpr const char* kQueryFooter = R"(
Questions stand one in a line, of numbers with commas between them, in world units; docs/queries.md tells what is found.
  --points  x,y,z                          which voxel is the point in
  --rays    x,y,z,dx,dy,dz[,t_min[,t_max]] what the ray hits first
  --boxes   x0,y0,z0,x1,y1,z1              which voxel is in the box, if it is not empty
  --nearest x,y,z[,distance]               which voxel is nearest, at most that far away
  --sweeps  x0,y0,z0,x1,y1,z1,dx,dy,dz     what the box meets first as it moves

Examples:
  zvo query bunny.zvo --nearest points.csv -o distances.csv
  echo 0,5,0,0,-1,0 | zvo query bunny.zvo --rays - -o -)";

constexpr const char* kInfoFooter = R"(
Examples:
  zvo info
  zvo info --json | jq '.devices[].missing')";

constexpr const char* kStructureHelp = "an octree, or a DAG, which has equal subtrees once (default svdag)";

// The options of pictures by path tracing.
void addPathOptions(CLI::App& render, RenderOptions& options)
{
    addNamed(render, "--integrator", options.frame.integrator, kIntegrators, kIntegratorHelp);
    PathOptions& path = options.frame.path;
    addValue(
        render, "--spp", options.samples, integerIn(1, 1U << 24), "N",
        fmt::format("samples a pixel: primary rays, paths, or frames of cache and cones, 1 to {} (default 4, 64 or 16)",
                    1U << 24));
    addValue(render, "--bounces", path.bounces, integerIn(0, kBouncesMax), "N",
             fmt::format("diffuse reflections of a path, 0 to {} (default 8)", kBouncesMax));
    addValue(render, "--seed", path.seed, integerIn(0, UINT32_MAX), "N",
             fmt::format("of the paths' random numbers, 0 to {} (default 0)", UINT32_MAX));
    addValue(render, "--settle", options.settle, integerIn(0, 1U << 24), "N",
             fmt::format("frames of --integrator cache before the first picture, 0 to {} (default {})", 1U << 24,
                         options.settle));
    addValue(render, "--rays", options.frame.radiance.faces, integerIn(1, kRadianceFacesMax), "N",
             fmt::format("faces that a frame of --integrator cache samples at most, 1 to {} (default 16384): each "
                         "takes up to two rays and two shadow rays",
                         kRadianceFacesMax));
    addNamed(render, "--shading", options.frame.shading, kShadings, kShadingHelp);
    addValue(render, "--aperture", path.lens_radius, parsePositive, "RADIUS",
             "radius of the lens of the camera, in world units (default: a pinhole)");
    addValue(render, "--focus", options.focus, parsePositive, "DISTANCE",
             "distance of the plane that is in focus, in world units (default: of what is at the picture's middle)");
    addEnvironmentOptions(render, options.environment, "; --sun adds the sun");
    render.add_flag("--denoise", options.frame.denoise,
                    "smooth the noise of few paths, but not edges; in sequences with the help of earlier pictures");
    render.add_flag("--aov", options.aovs,
                    "write albedo, normal, depth and motion as channels of the picture, which must be an .exr");
    addNamed(render, "--path-form", options.frame.path_form, kPathForms,
             "paths advance together, or one kernel follows each to its end; the picture is the same (default: as is "
             "faster on the device)");
    addValue(render, "--time-limit", options.time_limit, parseSeconds, "SECONDS",
             "begin no more samples after this time; the picture shows those that were traced");
}

void addOptions(CLI::App& render, RenderOptions& options)
{
    addVoxelOptions(render, options.voxels, "; or one .zvo or .vox file, which needs no voxelizing");
    addFillOption(render, options.voxels.fill);
    addShellOption(render, options.voxels.shell);
    addAttributesOption(render, options.voxels.attributes);
    render
        .add_option_function<std::string>(
            "--size",
            [&options](const std::string& text)
            { std::tie(options.width, options.height) = parseSize("--size", text); },
            "pixels of the picture (default 1280x720)")
        ->type_name("WxH");
    addCameraOption(render, options.camera);
    addValue(render, "--sheet", options.sheet, parseNames, "NAME,NAME,...",
             "several cameras of --camera, by their names, in one picture, such as front,right,top,iso")
        ->excludes("--camera");
    addValue(
        render, "--camera-path", options.camera_path, parsePath, "FILE",
        "a camera that flies along the keys in a JSON file; of --frames, frame N at N / frames_per_second seconds, or "
        "at --time")
        ->excludes("--camera")
        ->excludes("--sheet");
    addNamed(render, "--view", options.frame.trace.view, kViews, viewHelp())->type_name("VIEW");
    addValue(
        render, "--occlusion", options.frame.trace.occlusion_rays, integerIn(0, kOcclusionRaysMax), "RAYS",
        fmt::format("rays a sample that find how much of the sky it sees, 0 to {} (default 8)", kOcclusionRaysMax));
    addValue(render, "--sun", options.to_sun, parseDirection, "x,y,z", "direction to the sun (default -0.6,0.75,0.45)");
    addTimeOfDayOption(render, [&options](const glm::dvec3& to_sun) { options.to_sun = to_sun; })->excludes("--sun");
    addPathOptions(render, options);
    addValue(
        render, "--exposure", options.frame.exposure,
        [](std::string_view option, std::string_view text)
        { return Exposure{.automatic = false, .factor = static_cast<float>(parsePositive(option, text))}; },
        "FACTOR", "brightness of the picture (default 1; of samples by the first picture)");
    addValue(render, "--detail", options.frame.trace.detail_pixels, parsePositive, "PIXELS",
             "rays stop at octree nodes up to this many pixels wide (default: they go on to voxels)");
    addValue(render, "--frames", options.frames, parseFrames, "A..B",
             "pictures of a scene in which something moves, frame N at N / frames_per_second seconds; of any other "
             "scene, a camera that turns once around it; #### in the output's name becomes the frame's number; a .webp "
             "without that has all of them")
        ->excludes("--time");
    addValue(
        render, "--turntable", options.frames,
        [&options](std::string_view option, std::string_view text)
        {
            options.turntable = true;
            return parseFrameCount(option, text);
        },
        "N", "as --frames 0..N-1 of a camera that turns once around; what moves stands as at --time")
        ->excludes("--frames")
        ->excludes("--camera-path");
    addStructureOption(
        render, options.structure,
        "trace an octree, or a DAG, which has equal subtrees once; what moves is merged with either (default svo)");
    render.add_flag("--rebuild", options.rebuild,
                    "voxelize everything anew for each picture of a scene in which something moves, instead of "
                    "merging what moves with what stands still");
    addOutputOptions(render, options.output,
                     "the picture, a .png, .jpg or .webp file, or of light an .exr or .hdr file; - is standard output, "
                     "of a .png");
    addValue(render, "--quality", options.quality, integerIn(1, 100), "N",
             "of a .jpg or .webp, 1 to 100 (default 90); a .webp of 100 loses nothing")
        ->group("Output");
    addDeviceOptions(render, options.device);
}

void addOptions(CLI::App& voxelize, VoxelizeOptions& options)
{
    addVoxelOptions(voxelize, options.voxels);
    addFillOption(voxelize, options.voxels.fill);
    addShellOption(voxelize, options.voxels.shell);
    addAttributesOption(voxelize, options.voxels.attributes);
    addOutputOptions(voxelize, options.output, "the voxels, a .morton or .ply file; - is standard output");
    addValue(
        voxelize, "--format", options.format,
        [](std::string_view option, std::string_view text) {
            return oneOf(option, text, {"morton", "ply"});
        },
        "morton|ply", "what to write (default: as the output's extension says)")
        ->group("Output");
    addDeviceOptions(voxelize, options.device);
}

void addOptions(CLI::App& build, BuildFileOptions& options)
{
    addVoxelOptions(build, options.voxels);
    addFillOption(build, options.voxels.fill);
    addShellOption(build, options.voxels.shell);
    addValue(build, "--distance", options.distance, integerIn(1, DistanceOptions::kBandMax), "VOXELS",
             "in place of a tree, the signed distances of voxels' centres to the surface, as far as that: a level set "
             "in a .nvdb file")
        ->group("Scene");
    addStructureOption(build, options.structure, kStructureHelp);
    static constexpr auto kAttributeFormats =
        std::to_array<Named<AttributeFormat>>({{"none", AttributeFormat::None},
                                               {"4", AttributeFormat::Bytes4},
                                               {"8", AttributeFormat::Bytes8},
                                               {"block", AttributeFormat::Blocks}});
    addNamed(build, "--attributes", options.voxels.attributes, kAttributeFormats,
             "colour, normal and emission of the voxels: colour and normal in 4 or 8 bytes or in blocks of 16, "
             "which take 24; or only their places (default 8)",
             "none, 4, 8 or block");
    addOutputOptions(build, options.output, "the tree, a .zvo file, or distances, a .nvdb file; - is standard output");
    addDeviceOptions(build, options.device);
}

void addOptions(CLI::App& inspect, InspectOptions& options)
{
    inspect.add_option("FILE", options.file, "a .zvo or .vox file")->required()->type_name("FILE");
    inspect.add_flag("--json", options.json, "as JSON");
}

void addOptions(CLI::App& validate, ValidateOptions& options)
{
    validate.add_option("FILE", options.file, "a .zvo or .vox file")->required()->type_name("FILE");
}

// The output of a command that writes a tree as a file of any kind.
void addTreeOutput(CLI::App& app, OutputOptions& output, std::string& format, bool& strict)
{
    addOutput(app, "-o,--output", output.path, "FILE",
              "a .ply, .vox, .morton, .glb, .nvdb or .zvo file; - is standard output")
        ->required()
        ->group("Output");
    app.add_flag("-f,--force", output.overwrite, "overwrite a file that exists")->group("Output");
    addValue(
        app, "--format", format,
        [](std::string_view option, std::string_view text) {
            return oneOf(option, text, {"ply", "vox", "morton", "glb", "nvdb", "zvo"});
        },
        "FORMAT", "what to write: ply, vox, morton, glb, nvdb or zvo (default: as the output's extension says)")
        ->group("Output");
    app.add_flag("--strict", strict, "refuse what would be left out with a warning")->group("Output");
    addQuietOption(app);
}

void addOptions(CLI::App& convert, ConvertOptions& options)
{
    convert.add_option("FILE", options.file, "a .zvo or .vox file")->required()->type_name("FILE");
    addStructureOption(convert, options.structure, kStructureHelp);
    addTreeOutput(convert, options.output, options.format, options.strict);
    addDeviceOptions(convert, options.device);
}

void addOptions(CLI::App& edit, EditOptions& options)
{
    edit.add_option("FILE", options.file, "a .zvo or .vox file")->required()->type_name("FILE");
    edit.add_option("SCRIPT", options.script, "what to do: carve, fill and paint (docs/editing.md)")
        ->required()
        ->type_name("FILE");
    addStructureOption(edit, options.structure, "of a .zvo output, an octree or a DAG (default: as the file)");
    addTreeOutput(edit, options.output, options.format, options.strict);
    addDeviceOptions(edit, options.device);
}

void addOptions(CLI::App& algebra, AlgebraOptions& options)
{
    algebra.add_option("FILE", options.file, "a .zvo or .vox file")->required()->type_name("FILE");
    const auto addFile = [&](const char* name, AlgebraKind kind, const char* what)
    {
        algebra
            .add_option_function<std::string>(
                name,
                [&options, kind](const std::string& file) {
                    options.steps.push_back({kind, file, 0});
                },
                what)
            ->type_name("FILE")
            ->trigger_on_parse()
            ->group("Steps");
    };
    const auto addCount = [&](const std::string& name, AlgebraKind kind, std::uint32_t most, const char* what)
    {
        algebra
            .add_option_function<std::string>(
                name,
                [&options, kind, name, most](const std::string& text) {
                    options.steps.push_back({kind, {}, integerIn(1, most)(name, text)});
                },
                what)
            ->type_name("N")
            ->trigger_on_parse()
            ->group("Steps");
    };
    constexpr std::uint32_t kVoxelsMax = 256;
    addFile("--unite", AlgebraKind::Unite, "adds the voxels of another tree");
    addFile("--intersect", AlgebraKind::Intersect, "leaves the voxels that another tree has, too");
    addFile("--subtract", AlgebraKind::Subtract, "takes away the voxels of another tree");
    addCount("--dilate", AlgebraKind::Dilate, kVoxelsMax, "adds the neighbours of voxels, N times");
    addCount("--erode", AlgebraKind::Erode, kVoxelsMax, "takes away voxels beside empty ones, N times");
    addCount("--open", AlgebraKind::Open, kVoxelsMax, "erodes and dilates, which takes away what is thin");
    addCount("--close", AlgebraKind::Close, kVoxelsMax, "dilates and erodes, which closes holes and gaps");
    algebra
        .add_flag_callback(
            "--enclose",
            [&options] {
                options.steps.push_back({AlgebraKind::Enclose, {}, 0});
            },
            "fills what voxels enclose, by a flood from outside through faces of empty cells")
        ->trigger_on_parse()
        ->group("Steps");
    addCount("--keep-largest", AlgebraKind::KeepLargest, UINT32_MAX, "keeps the N largest components");
    addCount("--keep-from", AlgebraKind::KeepFrom, UINT32_MAX, "keeps the components of N voxels or more");
    addValue(
        algebra, "--neighbors", options.corners,
        [](std::string_view option, std::string_view text) {
            return oneOf(option, text, {"6", "26"}) == "26";
        },
        "6|26",
        "neighbours of a voxel: across faces, or all (default: 26 of components, as thin surfaces hold together by, "
        "else 6)");
    addText(algebra, "--components", options.components, "FILE",
            "a CSV file of the components of the result: their voxels, and the cell of one of these")
        ->group("Output");
    addStructureOption(algebra, options.structure, "of a .zvo output, an octree or a DAG (default: a DAG)");
    addTreeOutput(algebra, options.output, options.format, options.strict);
    algebra.get_option("--output")->required(false);
    addDeviceOptions(algebra, options.device);
}

void addOptions(CLI::App& query, QueryOptions& options)
{
    query.add_option("FILE", options.file, "a .zvo or .vox file")->required()->type_name("FILE");
    std::vector<CLI::Option*> kinds;
    const auto addKind = [&](const char* name, QueryKind kind, const char* what)
    {
        CLI::Option* const option = query
                                        .add_option_function<std::string>(
                                            name,
                                            [&options, kind](const std::string& file)
                                            {
                                                options.kind = kind;
                                                options.questions = file;
                                            },
                                            what)
                                        ->type_name("FILE");
        for (CLI::Option* const other : kinds)
        {
            option->excludes(other);
        }
        kinds.push_back(option);
    };
    addKind("--points", QueryKind::Point, "points: which voxels they are in; - is standard input, here and below");
    addKind("--rays", QueryKind::Ray, "rays: what they hit first");
    addKind("--boxes", QueryKind::Box, "boxes: voxels in them, or that they are empty");
    addKind("--nearest", QueryKind::Nearest, "points: the nearest voxels");
    addKind("--sweeps", QueryKind::Sweep, "boxes that move: what they meet first");
    addValue(
        query, "--format", options.format,
        [](std::string_view option, std::string_view text) {
            return oneOf(option, text, {"csv", "bin"}) == "bin" ? QueryFormat::Binary : QueryFormat::Csv;
        },
        "csv|bin", "of questions and answers (default: csv, and bin for files that end in .bin)");
    addText(query, "-o,--output", options.output.path, "FILE",
            "the answers, in the order of the questions; - is "
            "standard output")
        ->required()
        ->group("Output");
    query.add_flag("-f,--force", options.output.overwrite, "overwrite a file that exists")->group("Output");
    addQuietOption(query);
    addDeviceOptions(query, options.device);
}

void addOptions(CLI::App& info, InfoOptions& options)
{
    info.add_flag("--json", options.json, "as JSON");
    addText(info, "--device", options.device, "NAME", "which device would be used for this choice");
}

} // namespace

int runCommandLine(int argc, const char* const* argv)
{
    setQuiet(false);
    return runProgram(
        [&]
        {
            CLI::App app("zvo turns triangle scenes into sparse voxel octrees on the GPU and ray traces them.", "zvo");
            describeProgram(app, kMainFooter);
            Commands commands(app);
            commands.add("render", "voxelize scenes, or load a tree, and ray trace a picture", kRenderFooter,
                         addOptions, render);
            commands.add("voxelize", "voxelize scenes and write the voxels", kVoxelizeFooter, addOptions, voxelize);
            commands.add("build", "voxelize scenes and write the tree to a .zvo file", kBuildFooter, addOptions,
                         buildFile);
            commands.add("inspect", "tell what is in a .zvo or .vox file", kInspectFooter, addOptions, inspect);
            commands.add("validate", "check everything in a .zvo or .vox file", kValidateFooter, addOptions, validate);
            commands.add("convert", "make another kind of file of a .zvo or .vox file", kConvertFooter, addOptions,
                         convert);
            commands.add("edit", "carve, fill and paint voxels of a .zvo or .vox file", kEditFooter, addOptions, edit);
            commands.add("algebra", "unite, dilate, clean and fill the voxels of .zvo or .vox files", kAlgebraFooter,
                         addOptions, algebra);
            commands.add("query", "ask a .zvo or .vox file about points, rays and boxes", kQueryFooter, addOptions,
                         query);
            commands.add("info", "list the Vulkan devices and what they offer", kInfoFooter, addOptions, info);
            commands.run(argc, argv);
        });
}

} // namespace zvo::cli
