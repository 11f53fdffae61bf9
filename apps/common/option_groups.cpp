// SPDX-License-Identifier: MIT
#include "common/option_groups.h"

#include "common/parse.h"
#include "common/progress.h"
#include "core/base/grid.h"
#include "core/base/tuning.h"
#include "core/scene/points.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr float kVoxelSizeMin = 1e-35F; // 256 / voxel_size must be a finite number
constexpr const char* kAttributesHelp =
    "colour, normal and emission of the voxels, or only their places (default full)";

GridPosition parseGridPosition(std::string_view option, std::string_view text)
{
    const std::vector<float> v = parseFloats(option, text);
    if (v.size() != 4 || v[3] < kVoxelSizeMin)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} {}: expected x,y,z,voxel_size with a voxel size above 0", option, text));
    }
    return {{v[0], v[1], v[2]}, v[3]};
}

} // namespace

CLI::Option* addText(CLI::App& app, const char* name, std::string& target, const char* type, const char* what)
{
    return app.add_option(name, target, what)->type_name(type);
}

CLI::Option* addOutput(CLI::App& app, const std::string& name, std::string& target, const char* type, const char* what)
{
    const auto check = [option = name.substr(0, name.find(','))](const std::string& file)
    {
        if (file.empty())
        {
            throw Error(ErrorCode::Usage, option + " needs a file's name");
        }
    };
    return addText(app, name.c_str(), target, type, what)->each(check);
}

std::string oneOf(std::string_view option, std::string_view text, std::initializer_list<std::string_view> names)
{
    if (std::ranges::find(names, text) == names.end())
    {
        throw Error(ErrorCode::Usage, fmt::format("{} {}: expected one of {}", option, text, fmt::join(names, ", ")));
    }
    return std::string(text);
}

void addFolder(CLI::App& app, const char* name, std::optional<std::filesystem::path>& folder, const std::string& what)
{
    addValue(app, name, folder, parsePath, "DIR", what);
}

void addDeviceOptions(CLI::App& app, DeviceOptions& options)
{
    addText(app, "--device", options.device, "NAME", "device by a part of its name, its number in zvo info, or cpu")
        ->group("Device");
    addValue(app, "--memory-limit", options.memory_limit, parseBytes, "BYTES",
             "device memory that may be used, such as 2G or 512M")
        ->group("Device");
    addValue(app, "--dispatch-ms", options.dispatch_ms, integerIn(0, 100000), "MS",
             "split work so that the device is busy about this long at a time, 0: never (default 400)")
        ->group("Device");
    addValue(
        app, "--tuning", options.tuning, parseTuning, "NAME=VALUE,...",
        "forms and sizes of kernels in place of those that zvo chooses, as zvo-bench tune prints them; results stay")
        ->group("Device");
    app.add_flag("--validation", options.validation,
                 "run with the Vulkan validation layers (core, synchronization); fail if they speak")
        ->group("Device");
    app.add_flag("--gpu-validation", options.gpu_validation, "the same with instrumented kernels, slow")
        ->group("Device");
}

void addCoverageOption(CLI::App& app, Coverage& coverage)
{
    addNamed(app, "--coverage", coverage, kCoverages,
             "which voxels a triangle covers: a gap-free layer, or all that it touches (default thin)",
             "thin or conservative");
}

void addFillOption(CLI::App& app, Fill& fill)
{
    addNamed(
        app, "--fill", fill, kFills,
        "also the voxels that surfaces enclose: whose winding number is not 0, or odd; or by what most rays say, where "
        "surfaces have holes (default none)",
        "none, solid, parity or robust");
}

void addShellOption(CLI::App& app, Shell& shell)
{
    addNamed(app, "--shell", shell, kShells,
             "with --fill, which voxels of the surface there are: all, or none but those whose centres are inside "
             "(default surface)",
             "surface or none");
}

void addAttributesOption(CLI::App& app, bool& attributes)
{
    static constexpr auto kNames = std::to_array<Named<bool>>({{"full", true}, {"none", false}});
    addNamed(app, "--attributes", attributes, kNames, kAttributesHelp, "full or none");
}

void addAttributesOption(CLI::App& app, AttributeFormat& attributes)
{
    static constexpr auto kNames =
        std::to_array<Named<AttributeFormat>>({{"full", AttributeFormat::Bytes8}, {"none", AttributeFormat::None}});
    addNamed(app, "--attributes", attributes, kNames, kAttributesHelp, "full or none");
}

void addLoadOptions(CLI::App& app, LoadOptions& options)
{
    addNamed(app, "--up", options.up, kAxes,
             "which axis points up in the files: x, y, z, -x, -y or -z; it becomes y (default y)",
             "x, y, z, -x, -y or -z")
        ->type_name("AXIS");
    addValue(app, "--scale", options.scale, parsePositive, "FACTOR",
             "multiplies the files' coordinates, after --up (default 1)");
    app.add_flag("--bind-pose", options.bind_pose,
                 "meshes stand as they were modelled, without their skins, morph weights and animations");
    addMaterialOptions(app, options);
}

void addMaterialOptions(CLI::App& app, LoadOptions& options)
{
    app.add_option(
           "--skip-material", options.skip_materials,
           "leaves out what has a material with a name like this, such as 'Outline*'; may be given several times")
        ->type_name("GLOB")
        ->expected(1)
        ->take_all();
    app.add_flag("--keep-hulls", options.keep_hulls,
                 "keeps inverted hulls, the dark outlines of toon shading, which are left out otherwise");
    addValue(app, "--point-size", options.point_size, integerIn(1, kPointSizeMax), "VOXELS",
             "edge of the cube of voxels that a point becomes (default 1)");
    app.add_flag("--strict", options.strict,
                 "refuse files of which something would be left out, or would have no voxels, with a warning");
}

void addVoxelOptions(CLI::App& app, VoxelOptions& options, const std::string& also)
{
    app.add_option("SCENE", options.scenes,
                   "glTF 2.0 (.glb, .gltf), OBJ, PLY and STL files, and text with points; several make one scene; or "
                   "one scene file "
                   "(.scene.json), which places them and lets them move" +
                       also)
        ->required()
        ->type_name("FILE");
    addLoadOptions(app, options.load);
    addFolder(app, "--scenes", options.scenes_folder,
              "folder of the files that a scene file names, those that do not lie beside it");
    addValue(app, "--time", options.time, parseSeconds, "SECONDS",
             "the time of a scene in which something moves; after its end it begins anew (default 0)");
    addValue(app, "--resolution", options.depth, parseResolution, "N",
             "voxels per edge of the grid, a power of two from 2 to 131072 (default: the scene file's, or else 512)");
    addValue(app, "--margin", options.margin, integerIn(0, 1U << (Grid::kDepthMax - 1)), "VOXELS",
             "free voxels of the grid at each side of the scene, to build in (default 0)");
    addCoverageOption(app, options.coverage);
    addValue(app, "--bounds", options.bounds, parseBounds, "x0,y0,z0,x1,y1,z1",
             "the grid is the cube from corner 0 on, as long as the box's longest edge");
    addValue(app, "--grid", options.grid_position, parseGridPosition, "x,y,z,SIZE",
             "the grid has exactly this origin and voxel size, as a JSON report states them");
    app.add_flag("--ground", options.ground,
                 "puts a grey disc below the scene; the grid becomes twice as wide, with voxels of the same size");
    app.final_callback(
        [&options]
        {
            if (options.bounds && options.grid_position)
            {
                throw Error(ErrorCode::Usage, "--bounds and --grid exclude each other");
            }
            if (options.margin && (options.bounds || options.grid_position))
            {
                throw Error(ErrorCode::Usage, "--margin goes without --bounds and --grid, which place the grid");
            }
        });
}

void addEnvironmentOptions(CLI::App& app, EnvironmentOptions& options, const std::string& also)
{
    addValue(app, "--environment", options.map, parsePath, "FILE",
             "a map of the light from all directions, .hdr or .exr, in place of sun and sky, or none for no light" +
                 also);
    addValue(app, "--environment-turn", options.turn, parseDegrees, "DEGREES",
             "turns the map about the vertical, counterclockwise from above (default 0)");
    addValue(app, "--environment-strength", options.strength, parsePositive, "FACTOR",
             "factor for the map's light (default 1)");
    addValue(app, "--background-blur", options.background_blur, parseBlur, "DEGREES",
             "blurs what the camera sees of the map, above 0 to 90; its light stays (default: sharp)");
}

CLI::Option* addTimeOfDayOption(CLI::App& app, const std::function<void(const glm::dvec3& to_sun)>& use)
{
    return app
        .add_option_function<std::string>(
            "--time-of-day", [use](const std::string& text) { use(parseTimeOfDay("--time-of-day", text)); },
            "the sun as at this time, 45 degrees north at an equinox: it rises at 6:00 in the east (+x), and stands in "
            "the south (+z) at 12:00")
        ->type_name("HH:MM");
}

void addOutputOptions(CLI::App& app, OutputOptions& options, const char* what)
{
    addOutput(app, "-o,--output", options.path, "FILE", what)->required()->group("Output");
    addOutput(app, "--json", options.json, "FILE|-", "write a report; - is standard output")->group("Output");
    app.add_flag("-f,--force", options.overwrite, "overwrite files that exist")->group("Output");
    addQuietOption(app);
}

void addQuietOption(CLI::App& app)
{
    app.add_flag_callback(
           "-q,--quiet", [] { setQuiet(true); },
           "no progress bar and no words on how it went: only warnings and errors")
        ->group("Output");
}

void addCameraOption(CLI::App& app, std::string& camera)
{
    addText(app, "--camera", camera, "NAME|ex,ey,ez,tx,ty,tz[,FOV]",
            "a camera of the scene; or auto, which frames everything, or close, where two thirds of the rays hit; or "
            "front, back, left, right, top, or iso, which has no perspective; or eye, target and vertical field of "
            "view in degrees (default: the scene's first camera, or else auto)");
}

} // namespace zvo::cli
