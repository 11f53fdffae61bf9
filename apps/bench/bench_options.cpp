// SPDX-License-Identifier: MIT
#include "bench/bench_options.h"

#include "bench/bench_balance.h"
#include "bench/bench_baselines.h"
#include "bench/bench_build.h"
#include "bench/bench_cache.h"
#include "bench/bench_denoise.h"
#include "bench/bench_dynamic.h"
#include "bench/bench_edit.h"
#include "bench/bench_path.h"
#include "bench/bench_queries.h"
#include "bench/bench_rays.h"
#include "bench/bench_report.h"
#include "bench/bench_solid.h"
#include "bench/bench_tune.h"
#include "common/command_line.h"
#include "common/option_groups.h"
#include "common/parse.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <string_view>
#include <tuple>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* kMainFooter = R"(
Where no scene is named, bunny_low.glb, dragon.glb and sponza.glb in the folder of --scenes are measured, or else zvo's
own scenes; dynamic and report need files, balance makes scenes. All print tables in Markdown, or JSON, or both.

Examples:
  zvo-bench build --scenes ../models --resolutions 256,512 --json build.json
  zvo-bench rays --scenes ../models --resolutions 256,512 --json rays.json
  zvo-bench report build.json rays.json --targets bench/targets.json

'zvo-bench COMMAND --help' tells the options of a command.
Exit codes: 0 success, 2 usage, 3 input, 4 output, 5 no usable device, 6 memory, 1 anything else.)";

constexpr const char* kBuildFooter = R"(
Each row is one scene at one resolution: a warm-up, then N runs on the device's timers. N copies of the octree are then
compressed to a DAG.

Examples:
  zvo-bench build scenes/knot.glb --resolutions 256 --runs 3
  zvo-bench build --scenes ../models --json build.json --passes)";

constexpr const char* kRaysFooter = R"(
Each row is one scene at one resolution: 3 N pictures of 1920x1080 of an octree and of its DAG in turns, after a
warm-up; the ratio is the DAG's time over the octree's. Where zvo-bench was built with Embree, it traces the same rays
on all processors, through the same voxels and through the triangles. --kinds: shadow rays to the sun and short ambient
rays from primary hits, rays of 8 bounces, random rays in the grid; what they load is that of 1024 warps.

Examples:
  zvo-bench rays scenes/knot.glb --resolutions 256 --camera close
  zvo-bench rays scenes/atrium.glb --resolutions 512 --kinds shadow,bounces
  zvo-bench rays --scenes ../models --json rays.json --passes)";

constexpr const char* kDynamicFooter = R"(
Each row is one scene at one resolution: an update in each frame of its duration, and N rebuilds and pictures.

Examples:
  zvo-bench dynamic scenes/atrium_knot.scene.json
  zvo-bench dynamic scenes/sponza_bunny.scene.json --scenes ../models --structure svdag)";

constexpr const char* kEditFooter = R"(
N strokes for each radius and action, each undone and redone; then what a stroke takes after 10, 100 and 1000.

Examples:
  zvo-bench edit scenes/atrium.glb --structure svdag)";

constexpr const char* kQueriesFooter = R"(
Lists of questions of each kind around voxels of a scene, which an octree and its DAG answer: points, rays, boxes, the
nearest voxel, and boxes that move.

Examples:
  zvo-bench queries scenes/atrium.glb --resolutions 256,1024)";

constexpr const char* kSolidFooter = R"(
Builds and primary rays of surfaces and of what is filled, in turns; dilation and erosion by a voxel, the union of what
is filled with what is eroded, and their difference; of the surface, the largest component and what is enclosed; and
distances.

Examples:
  zvo-bench solid scenes/knot.glb --resolutions 256,512)";

constexpr const char* kPathFooter = R"(
Paths in stages and in one kernel. Where zvo-bench was built with Embree, it traces the same rays of bounces, one by
one, on all processors.

Examples:
  zvo-bench path scenes/atrium.glb --environment forest.hdr
  zvo-bench path scenes/atrium.glb --resolutions 512,2048 --size 1920x1080)";

constexpr const char* kCacheFooter = R"(
By day, and at night where voxels give off light; primary rays and paths are there for comparison. Of scene files: how
fast light follows what moves in them, and how much it flickers.

Examples:
  zvo-bench cache scenes/atrium.glb scenes/atrium_knot.scene.json --size 160x90)";

constexpr const char* kDenoiseFooter = R"(
Pictures of 1, 4, 16 and 64 paths a pixel, with and without denoising, by day, and at night where voxels give off light.

Examples:
  zvo-bench denoise scenes/atrium.glb --reference 4096)";

constexpr const char* kBaselinesFooter = R"(
Each row is one algorithm of a source, or another program, beside zvo's own, in turns. Without scenes: also the two
scenes of the thesis, in which something moves. bench/results-page makes a page of the JSON.

Examples:
  zvo-bench baselines --scenes ../models)";

constexpr const char* kBalanceFooter = R"(
Each row is voxelization and octree construction of one scene: one large triangle, a patch of small ones, slivers,
crowds, and the scenes that were named, or those in the folder of --scenes. Ratios of them follow the table.

Examples:
  zvo-bench balance
  zvo-bench balance scenes/knot.glb scenes/atrium.glb)";

constexpr const char* kTuneFooter = R"(
Choices one after the other, their values in turns, N runs of each; then what is faster than zvo's choice, for --tuning.

Examples:
  zvo-bench tune scenes/atrium.glb
  zvo-bench tune scenes/atrium.glb --resolution 512 --size 1920x1080)";

constexpr const char* kReportFooter = R"(
In Markdown: the passes that take longest, with their time for each triangle, voxel, node and ray. Passes are in reports
of --passes.

Examples:
  zvo-bench report build.json rays.json --targets bench/targets.json)";

constexpr const char* kScenes = "glTF 2.0, OBJ, PLY and STL files, each measured on its own";
constexpr const char* kScenesOrFiles =
    "glTF 2.0, OBJ, PLY and STL files, and scene files (.scene.json), each measured on its own";
constexpr const char* kUsualFolder = "where the usual scenes are (default scenes)";
constexpr const char* kUsualFolderOrFiles = "where the usual scenes are (default scenes), or what scene files name";

CLI::Option* addScenes(CLI::App& app, BenchOptions& options, const char* scenes, const char* folder)
{
    addFolder(app, "--scenes", options.scene_folder, folder);
    return app.add_option("SCENE", options.scenes, scenes)->type_name("FILE");
}

// usual: the resolutions where none are given.
void addResolutions(CLI::App& app, BenchOptions& options, std::string_view usual)
{
    addValue(app, "--resolutions,--resolution", options.depths, parseResolutions, "N,...",
             fmt::format("powers of two from 2 to 131072 (default {})", usual));
}

// A whole number from 1 on.
void addCount(CLI::App& app, const char* name, std::uint32_t& count, std::uint32_t most, const std::string& what)
{
    addValue(app, name, count, integerIn(1, most), "N", what);
}

void addRuns(CLI::App& app, RepeatedBenchOptions& options, const char* what = "measured runs of each row")
{
    addCount(app, "--runs", options.run_count, 1000, fmt::format("{} (default 5)", what));
}

std::vector<std::string> parseKinds(std::string_view option, std::string_view text)
{
    std::vector<std::string> kinds = parseNames(option, text);
    for (const std::string& kind : kinds)
    {
        oneOf(option, kind, {"primary", "shadow", "ambient", "bounces", "random", "all"});
    }
    return kinds;
}

void addPassesFlag(CLI::App& app, PassBenchOptions& options)
{
    app.add_flag("--passes", options.passes, "also tell the time of each pass");
}

void addSize(CLI::App& app, PictureSizeOptions& options)
{
    const auto read = [&options](const std::string& text)
    { std::tie(options.width, options.height) = parseSize("--size", text); };
    app.add_option_function<std::string>("--size", read, "pixels of the picture (default 640x360)")->type_name("WxH");
}

void addReference(CLI::App& app, LitBenchOptions& options)
{
    addCount(app, "--reference", options.reference_samples, 1U << 20,
             "paths a pixel of the picture of many (default 1024)");
}

void addStructure(CLI::App& app, TreeStructure& structure, const std::string& what)
{
    addStructureOption(app, structure, fmt::format("{} is an octree or a DAG (default svo)", what));
}

// What all commands have that measure.
void addTreeAndDevice(CLI::App& app, BenchOptions& options)
{
    addCoverageOption(app, options.coverage);
    addAttributesOption(app, options.attributes);
    addDeviceOptions(app, options.device);
    addOutput(app, "--json", options.output.json, "FILE|-", "write a report; - is standard output, without the table")
        ->group("Output");
    app.add_flag("-f,--force", options.output.overwrite, "overwrite files that exist")->group("Output");
}

void addOptions(CLI::App& app, BenchBuildOptions& options)
{
    addScenes(app, options, kScenes, kUsualFolder);
    addResolutions(app, options, "256,512,1024");
    addRuns(app, options);
    addPassesFlag(app, options);
    addFillOption(app, options.fill);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchRaysOptions& options)
{
    addScenes(app, options, kScenes, kUsualFolder);
    addResolutions(app, options, "256,512,1024");
    addRuns(app, options, "measured runs of each row, three pictures each");
    addCameraOption(app, options.camera);
    addValue(app, "--kinds", options.kinds, parseKinds, "KIND,...",
             "also measure lists of rays: primary, shadow, ambient, bounces, random, or all");
    addPassesFlag(app, options);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchDynamicOptions& options)
{
    addScenes(app, options, "scene files (.scene.json) in which something moves, each measured on its own",
              "folder of the files that scene files name, those that do not lie beside them")
        ->required();
    addResolutions(app, options, "the scene file's, or else 512");
    addRuns(app, options, "measured rebuilds and pictures of each row");
    addStructure(app, options.structure, "what stands still");
    addCameraOption(app, options.camera);
    addPassesFlag(app, options);
    addMaterialOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchEditOptions& options)
{
    addScenes(app, options, kScenes, kUsualFolder);
    addResolutions(app, options, "512");
    addRuns(app, options, "measured strokes of each row");
    addStructure(app, options.structure, "what is edited");
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchQueriesOptions& options)
{
    addScenes(app, options, kScenes, kUsualFolder);
    addResolutions(app, options, "512");
    addCount(app, "--count", options.count, 1U << 24, "questions of each kind (default 1048576)");
    addRuns(app, options);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchSolidOptions& options)
{
    addScenes(app, options, kScenes, kUsualFolder);
    addResolutions(app, options, "512");
    addRuns(app, options);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchPathOptions& options)
{
    addScenes(app, options, kScenes, kUsualFolder);
    addResolutions(app, options, "512");
    addRuns(app, options);
    addSize(app, options);
    addCameraOption(app, options.camera);
    app.add_option("--environment", options.environments, "maps of light, .hdr or .exr")->type_name("FILE");
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchCacheOptions& options)
{
    addScenes(app, options, kScenesOrFiles, kUsualFolderOrFiles);
    addResolutions(app, options, "256");
    addSize(app, options);
    addReference(app, options);
    addCount(app, "--rays", options.faces, kRadianceFacesMax, "faces that a frame samples at most (default 16384)");
    addStructure(app, options.structure, "what stands still in scene files");
    addCameraOption(app, options.camera);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchDenoiseOptions& options)
{
    addScenes(app, options, kScenes, kUsualFolder);
    addResolutions(app, options, "128");
    addReference(app, options);
    addCameraOption(app, options.camera);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchBaselinesOptions& options)
{
    addScenes(app, options, kScenesOrFiles, kUsualFolderOrFiles);
    addResolutions(app, options, "256,512,1024, on a CPU 128,256");
    addRuns(app, options);
    addCameraOption(app, options.camera);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchBalanceOptions& options)
{
    addScenes(app, options, kScenes, "where the usual scenes are, to be measured, too");
    addResolutions(app, options, "512,1024,2048");
    addRuns(app, options);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
}

void addOptions(CLI::App& app, BenchTuneOptions& options)
{
    addScenes(app, options, "a glTF 2.0, OBJ, PLY or STL file (default: the last of the usual scenes)", kUsualFolder)
        ->expected(1);
    const auto read = [](std::string_view option, std::string_view text)
    { return std::vector{parseResolution(option, text)}; };
    addValue(app, "--resolution", options.depths, read, "N", "a power of two from 2 to 131072 (default 256)");
    addRuns(app, options, "measured runs of each value");
    addSize(app, options);
    addCameraOption(app, options.camera);
    addLoadOptions(app, options.load);
    addTreeAndDevice(app, options);
    app.remove_option(app.get_option("--tuning")); // it is what is measured
}

void addOptions(CLI::App& app, BenchReportOptions& options)
{
    app.add_option("FILE", options.reports, "JSON reports of the other commands")->required()->type_name("FILE");
    addValue(
        app, "--targets", options.targets, [](std::string_view, std::string_view text) { return fs::path(text); },
        "FILE", "also tell what the figures in this file ask for, such as bench/targets.json");
}

} // namespace

void runBenchCommandLine(int argc, const char* const* argv)
{
    CLI::App app("zvo-bench measures on Vulkan devices how sparse voxel octrees are made and traced.", "zvo-bench");
    describeProgram(app, kMainFooter);
    Commands commands(app);
    commands.add("build", "measure voxelization, octree construction and compression to a DAG", kBuildFooter,
                 addOptions, benchBuild);
    commands.add("rays", "measure primary rays through octree and DAG", kRaysFooter, addOptions, benchRays);
    commands.add("dynamic", "measure updates of scenes in which something moves, beside full rebuilds", kDynamicFooter,
                 addOptions, benchDynamic);
    commands.add("edit", "measure strokes of a brush: dabs, undo and redo", kEditFooter, addOptions, benchEdit);
    commands.add("queries", "measure questions to octree and DAG: points, boxes, nearest voxels", kQueriesFooter,
                 addOptions, benchQueries);
    commands.add("solid", "measure filled octrees beside surfaces, algebra of trees, and distances", kSolidFooter,
                 addOptions, benchSolid);
    commands.add("path", "measure path tracing: what rays cost, and variance by the way of finding light", kPathFooter,
                 addOptions, benchPath);
    commands.add("cache", "measure pictures by the radiance cache, beside one of many paths", kCacheFooter, addOptions,
                 benchCache);
    commands.add("denoise", "measure denoised pictures of few paths, beside one of many", kDenoiseFooter, addOptions,
                 benchDenoise);
    commands.add("baselines", "measure the algorithms of zvo's sources, and other programs, beside zvo's",
                 kBaselinesFooter, addOptions, benchBaselines);
    commands.add("balance", "measure how the time of a voxel depends on the triangles", kBalanceFooter, addOptions,
                 benchBalance);
    commands.add("tune", "measure each form and size of kernels that zvo chooses by device", kTuneFooter, addOptions,
                 benchTune);
    commands.add("report", "tell what reports have measured, pass by pass", kReportFooter, addOptions, benchReport);
    commands.run(argc, argv);
}

} // namespace zvo::cli
