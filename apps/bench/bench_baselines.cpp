// SPDX-License-Identifier: MIT
#include "bench/bench_baselines.h"

#include "baseline/baseline_kernels.h"
#include "bench/baseline_comparisons.h"
#include "bench/baseline_report.h"
#include "bench/bench_scenes.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/view.h"
#include "core/upload/gpu_scene.h"
#include "io/scene/animated_scene.h"
#include "runtime/live_scene.h"
#include "vk/headless.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

// A still scene has no dynamic objects.
struct BaselineScene
{
    std::string name;
    AnimatedScene animated;
};

AnimatedScene loadForBaselines(const BenchBaselinesOptions& options, const fs::path& path)
{
    if (!isSceneFile(path))
    {
        AnimatedScene still;
        still.fixed = loadWithWarnings(std::span(&path, 1), options.load);
        return still;
    }
    return loadSceneFile(options, path);
}

// The named scenes, or the usual ones and the thesis's, as far as their models are there.
std::vector<BaselineScene> loadBaselineScenes(const BenchBaselinesOptions& options)
{
    std::vector<BaselineScene> scenes;
    for (const fs::path& path : benchScenes(options, true))
    {
        const fs::path stem = path.stem();
        scenes.push_back({(isSceneFile(path) ? stem.stem() : stem).string(), loadForBaselines(options, path)});
    }
    if (!options.scenes.empty())
    {
        return scenes;
    }
    for (const fs::path& path : thesisScenes())
    {
        try
        {
            scenes.push_back({path.stem().stem().string(), loadForBaselines(options, path)});
        }
        catch (const Error& error)
        {
            if (error.code() != ErrorCode::Input)
            {
                throw;
            }
            talk(fmt::format("warning: left out: {}", error.what()));
        }
    }
    return scenes;
}

// Runs a comparison, or tells why it cannot be made.
template <typename Function>
void attempt(const std::string& scene, std::uint32_t depth, const char* compared, const Function& function)
{
    try
    {
        function();
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory && error.code() != ErrorCode::Usage)
        {
            throw;
        }
        talk(fmt::format("warning: {} at {} without {}: {}", scene, 1U << depth, compared, error.what()));
    }
}

void compareScene(const BenchBaselinesOptions& options, vk::HeadlessDevice& device, const BaselineScene& scene,
                  const GpuScene& uploaded, std::uint32_t depth, BaselineRows& rows)
{
    const AnimatedScene& animated = scene.animated;
    const bool moves = !animated.objects.empty();
    const Bounds bounds = boundsOverTime(animated);
    const Grid grid = gridOf(animated, bounds, depth);
    const double aspect = double{kBaselineWidth} / kBaselineHeight;
    const Bounds subject_bounds = subjectOf(bounds, grid);
    const ViewCamera camera = moves ? chooseCamera(options.camera, animated, subject_bounds, aspect)
                                    : chooseCamera(options.camera, animated.fixed, subject_bounds, aspect);
    BaselineSubject subject(options, device, scene.name, animated.fixed, uploaded, grid, camera);
    subject.addSize(rows, "zvo octree", subject.octree().node_count, subject.octree().geometryBytes());
    attempt(scene.name, depth, "the thesis's algorithms", [&] { compareThesis(subject, rows); });
    attempt(scene.name, depth, "Crassin and Green's construction", [&] { compareCrassinGreen(subject, rows); });
    if (moves)
    {
        attempt(scene.name, depth, "the thesis's update", [&] { compareThesisUpdate(subject, animated, rows); });
    }
    else
    {
        attempt(scene.name, depth, "the slides' algorithms", [&] { compareSlides(subject, rows); });
        attempt(scene.name, depth, "the host's algorithms", [&] { compareHost(subject, rows); });
    }
    attempt(scene.name, depth, "orders of nodes", [&] { compareOrders(subject, moves ? &animated : nullptr, rows); });
}

} // namespace

void benchBaselines(const BenchBaselinesOptions& options)
{
    const std::vector<BaselineScene> scenes = loadBaselineScenes(options);
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), baseline::allKernels());
    const bool is_cpu = device.device().report().type == "cpu";
    const std::vector<std::uint32_t> depths =
        options.depths.value_or(is_cpu ? std::vector{7U, 8U} : std::vector{8U, 9U, 10U});
    BaselineRows rows;
    Progress progress(scenes.size() * depths.size());
    for (const BaselineScene& scene : scenes)
    {
        const GpuScene uploaded =
            uploadScene(device, scene.animated.fixed, options.attributes, brightestEmission(scene.animated));
        for (const std::uint32_t depth : depths)
        {
            progress.begin(fmt::format("{} at {}", scene.name, 1U << depth));
            attempt(scene.name, depth, "an octree",
                    [&] { compareScene(options, device, scene, uploaded, depth, rows); });
        }
    }
    clearProgressBar();
    if (options.output.json != "-")
    {
        Output table("-", true);
        table.write(baselineTables(device.device().report(), options, rows));
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, baselineJson(device.device().report(), options, rows));
    }
}

} // namespace zvo::cli
