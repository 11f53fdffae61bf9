// SPDX-License-Identifier: MIT
#include "bench/bench_options.h"

#include "common/option_groups.h"
#include "common/parse.h"
#include "zvo/error.h"

#include <CLI/CLI.hpp>

#include <tuple>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* kBenchFooter = R"(
Each row is one scene at one resolution: a warm-up, then N runs on the device's timers. Its octree is compressed to a
DAG; 3 N pictures of either are traced in turns, and "ratio" is the DAG's time over the octree's. Where zvo was built with
Embree, the same rays are also traced by Embree on all processors, through the same voxels and through the triangles.
Without scenes: bunny_low.glb, dragon.glb and sponza.glb in the folder of --scenes, or the project's own scenes.
--balance: each row is voxelization and octree construction alone; ratios of them follow the table.
--baselines: each row is one algorithm of a source, or another program, beside zvo's own. Without scenes: also the two
scenes of the thesis, in which something moves. bench/results-page makes a page of the JSON.
--dynamic: the scenes are scene files (.scene.json), what they name lies beside them or in the folder of --scenes.
--edit: N strokes for each radius and action, each undone and redone; then what a stroke takes after 10, 100 and 1000.

--denoise: pictures of 1 to 64 paths a pixel, with and without denoising, beside one of very many.
--kept: pictures of light that is kept on voxels, beside one of very many paths; primary rays and paths for comparison.
  Of scene files: how fast light follows what moves in them, and how much it flickers.
--path: the rays of paths beside primary rays and Embree's; each way of finding light beside chance.
--tune: choices one after the other, their values in turns.
--report: the passes that take longest, with their time for each triangle, voxel, node and ray.

Examples:
  zvo bench scenes/knot.glb --resolutions 256 --runs 3
  zvo bench --scenes ../models --json bench.json --passes
  zvo bench --balance scenes/knot.glb scenes/atrium.glb
  zvo bench --baselines --scenes ../models
  zvo bench --dynamic scenes/atrium_knot.scene.json
  zvo bench --edit scenes/atrium.glb --structure svdag
  zvo bench --denoise scenes/atrium.glb --reference 4096
  zvo bench --kept scenes/atrium.glb scenes/atrium_knot.scene.json --size 160x90
  zvo bench --path scenes/atrium.glb --environment forest.hdr
  zvo bench --tune scenes/atrium.glb
  zvo bench --report bench.json --targets bench/targets.json)";

} // namespace

CLI::App* addBench(CLI::App& app, BenchOptions& options)
{
    CLI::App* bench =
        app.add_subcommand("bench", "measure voxelization, octree construction, compression and ray tracing");
    bench->add_option("SCENE", options.scenes, "glTF 2.0, OBJ, PLY and STL files, each measured on its own")
        ->type_name("FILE");
    addFolder(*bench, "--scenes", options.scene_folder,
              "where the usual scenes are (default scenes), or what scene files name");
    addValue(*bench, "--resolutions,--resolution", options.depths, parseResolutions, "N,...",
             "powers of two from 2 to 131072 (default 256,512,1024; with --balance 512,1024,2048, "
             "with --baselines on a CPU 128,256, "
             "with --dynamic, --edit and --path 512, with --tune and --kept 256, with --denoise 128)");
    addValue(
        *bench, "--runs", options.run_count,
        [](std::string_view option, std::string_view text)
        { return static_cast<std::uint32_t>(parseInteger(option, text, 1, 1000)); },
        "N", "measured runs of each row (default 5)");
    addLoadOptions(*bench, options.load);
    addCoverageOption(*bench, options.coverage);
    addAttributesOption(*bench, options.attributes);
    addCameraOption(*bench, options.camera);
    bench->add_flag("--passes", options.passes, "also tell the time of each pass");
    bench
        ->add_flag("--balance", options.balance,
                   "measure instead how the time of a voxel depends on the triangles: one large triangle, a patch of "
                   "small ones, slivers, crowds, and the scenes that were named")
        ->excludes("--passes")
        ->excludes("--camera");
    bench
        ->add_flag("--baselines", options.baselines,
                   "measure instead the algorithms of zvo's sources beside zvo's own: the thesis's, Crassin and "
                   "Green's, the slides', Embree's, and others on the host")
        ->excludes("--balance")
        ->excludes("--passes");
    bench
        ->add_flag("--dynamic", options.dynamic,
                   "measure instead scenes in which something moves: update of the octree against a full rebuild")
        ->excludes("--balance")
        ->excludes("--baselines")
        ->excludes("--up")
        ->excludes("--scale");
    addValue(
        *bench, "--structure", options.structure, parseStructure, "svo|svdag",
        "with --dynamic and --edit, and --kept of scene files, what stands still, or is edited, is an octree or a DAG "
        "(default svo)");
    bench
        ->add_flag("--edit", options.edit,
                   "measure instead strokes of a brush: dabs, undo and redo, by radius and by number of strokes")
        ->excludes("--balance")
        ->excludes("--baselines")
        ->excludes("--dynamic")
        ->excludes("--passes")
        ->excludes("--camera");
    bench
        ->add_flag("--path", options.path,
                   "measure instead path tracing: what rays cost, and the variance by the way of finding light")
        ->excludes("--balance")
        ->excludes("--baselines")
        ->excludes("--dynamic")
        ->excludes("--edit")
        ->excludes("--passes");
    bench->add_option("--environment", options.environments, "with --path, maps of light, .hdr or .exr")
        ->type_name("FILE")
        ->needs("--path");
    CLI::Option* const size = bench->add_option_function<std::string>(
        "--size",
        [&options](const std::string& text)
        { std::tie(options.path_width, options.path_height) = parseSize("--size", text); },
        "with --path, --tune and --kept, pixels of the picture (default 640x360)");
    size->type_name("WxH");
    CLI::Option* const reference = addValue(
        *bench, "--reference", options.reference_samples,
        [](std::string_view option, std::string_view text)
        { return static_cast<std::uint32_t>(parseInteger(option, text, 1, 1U << 20)); },
        "N", "with --denoise and --kept, paths a pixel of the picture of many (default 1024)");
    bench->final_callback(
        [size, reference, &options]
        {
            if (size->count() != 0 && !options.path && !options.tune && !options.kept)
            {
                throw Error(ErrorCode::Usage, "--size goes with --path, --tune or --kept");
            }
            if (reference->count() != 0 && !options.denoise && !options.kept)
            {
                throw Error(ErrorCode::Usage, "--reference goes with --denoise or --kept");
            }
        });
    bench
        ->add_flag("--denoise", options.denoise,
                   "measure instead how close denoised pictures of few paths come to one of many, by day and at night")
        ->excludes("--balance")
        ->excludes("--baselines")
        ->excludes("--dynamic")
        ->excludes("--edit")
        ->excludes("--path")
        ->excludes("--passes");
    bench
        ->add_flag("--kept", options.kept,
                   "measure instead how close pictures of light that is kept on voxels come to many paths, by day and "
                   "at night, and what they take")
        ->excludes("--balance")
        ->excludes("--baselines")
        ->excludes("--dynamic")
        ->excludes("--edit")
        ->excludes("--path")
        ->excludes("--denoise")
        ->excludes("--passes");
    addValue(
        *bench, "--rays", options.kept_faces,
        [](std::string_view option, std::string_view text)
        { return static_cast<std::uint32_t>(parseInteger(option, text, 1, kRadianceFacesMax)); },
        "N", "with --kept, faces that a frame samples at most (default 16384)")
        ->needs("--kept");
    addDeviceOptions(*bench, options.device);
    bench
        ->add_flag("--tune", options.tune,
                   "measure instead each form and size of kernels that zvo chooses by device, with one scene at one "
                   "resolution, and print what is faster than its choice, for --tuning")
        ->excludes("--balance")
        ->excludes("--baselines")
        ->excludes("--dynamic")
        ->excludes("--edit")
        ->excludes("--path")
        ->excludes("--denoise")
        ->excludes("--kept")
        ->excludes("--passes")
        ->excludes("--tuning");
    CLI::Option* const report =
        bench
            ->add_option("--report", options.reports,
                         "measure nothing: tell in Markdown what these JSON reports have measured, pass by pass")
            ->type_name("FILE");
    for (const char* const other : {"SCENE", "--balance", "--baselines", "--dynamic", "--edit", "--path", "--denoise",
                                    "--kept", "--tune", "--passes"})
    {
        report->excludes(other);
    }
    addValue(
        *bench, "--targets", options.targets, [](std::string_view, std::string_view text) { return fs::path(text); },
        "FILE", "with --report, also tell what the figures in this file ask for, such as bench/targets.json")
        ->needs("--report");
    addText(*bench, "--json", options.output.json, "FILE|-", "write a report; - is standard output, without the table")
        ->group("Output");
    bench->add_flag("-f,--force", options.output.overwrite, "overwrite files that exist")->group("Output");
    bench->footer(kBenchFooter);
    return bench;
}

} // namespace zvo::cli
