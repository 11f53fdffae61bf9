// SPDX-License-Identifier: MIT
#include "bench/bench_dynamic.h"

#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/bench_table.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/view.h"
#include "core/base/kernels.h"
#include "core/trace/tree_tracer.h"
#include "core/upload/gpu_scene.h"
#include "runtime/live_scene.h"
#include "runtime/trees.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

// The picture's size in the thesis.
constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 720;
constexpr std::uint32_t kDepth = 9;
constexpr std::uint32_t kTraceTurns = 3; // pictures of each octree for each rebuild

// Least and greatest of several counts.
struct Range
{
    std::uint64_t min = UINT64_MAX;
    std::uint64_t max = 0;

    void add(std::uint64_t value)
    {
        min = std::min(min, value);
        max = std::max(max, value);
    }
};

std::string rangeText(const Range& range)
{
    return range.min == range.max ? fmt::format("{}", range.min) : fmt::format("{}-{}", range.min, range.max);
}

Json rangeJson(const Range& range)
{
    return {{"min", range.min}, {"max", range.max}};
}

// One scene at one resolution.
struct DynamicRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::uint64_t triangles_static = 0;
    std::uint64_t triangles_dynamic = 0;
    std::uint64_t voxels_static = 0;
    std::uint64_t nodes_static = 0;
    std::uint64_t geometry_bytes_static = 0;
    Range voxels_dynamic; // covered by dynamic objects
    Range nodes_dynamic;  // of the overlays
    double voxelize_ms = 0;
    double build_ms = 0;
    std::uint32_t frame_count = 0;
    Spread dynamic_voxelize_ms;
    Spread update_ms;
    Spread rebuild_ms;
    Spread rebuild_moving_ms; // of the dynamic objects alone
    std::optional<Spread>
        enlarged_ms; // dynamic voxelization and update in a grid four times as large, with the same voxels
    Spread trace_merged_ms;
    Spread trace_rebuilt_ms;
    std::uint32_t retry_count = 0;
    std::vector<vk::PassTime> passes; // of the updates: mean of the frames, summed by name
};

const Columns<DynamicRow>& columns()
{
    static const Columns<DynamicRow> all = {
        {"scene", 12, [](const DynamicRow& row) { return row.scene; }},
        {"resolution", 10, [](const DynamicRow& row) { return fmt::format("{}", row.resolution); }},
        {"triangles", 9, [](const DynamicRow& row) { return fmt::format("{}", row.triangles_static); }},
        {"moving", 7, [](const DynamicRow& row) { return fmt::format("{}", row.triangles_dynamic); }},
        {"voxels", 9, [](const DynamicRow& row) { return fmt::format("{}", row.voxels_static); }},
        {"moving", 15, [](const DynamicRow& row) { return rangeText(row.voxels_dynamic); }},
        {"nodes", 9, [](const DynamicRow& row) { return fmt::format("{}", row.nodes_static); }},
        {"overlay", 15, [](const DynamicRow& row) { return rangeText(row.nodes_dynamic); }},
        {"voxelize ms", 11, [](const DynamicRow& row) { return fmt::format("{:.2f}", row.voxelize_ms); }},
        {"build ms", 8, [](const DynamicRow& row) { return fmt::format("{:.2f}", row.build_ms); }},
        {"dynamic voxelize ms", 22, [](const DynamicRow& row) { return spreadText(row.dynamic_voxelize_ms); }},
        {"update ms", 22, [](const DynamicRow& row) { return spreadText(row.update_ms); }},
        {"in 4x the grid ms", 22,
         [](const DynamicRow& row) { return row.enlarged_ms ? spreadText(*row.enlarged_ms) : "-"; }},
        {"rebuild ms", 25, [](const DynamicRow& row) { return spreadText(row.rebuild_ms); }},
        {"moving alone ms", 25, [](const DynamicRow& row) { return spreadText(row.rebuild_moving_ms); }},
        {"trace merged ms", 22, [](const DynamicRow& row) { return spreadText(row.trace_merged_ms); }},
        {"trace rebuilt ms", 22, [](const DynamicRow& row) { return spreadText(row.trace_rebuilt_ms); }},
    };
    return all;
}

Json rowJson(const DynamicRow& row)
{
    Json json;
    json["scene"] = row.scene;
    json["resolution"] = row.resolution;
    json["triangles_static"] = row.triangles_static;
    json["triangles_dynamic"] = row.triangles_dynamic;
    json["voxels_static"] = row.voxels_static;
    json["voxels_dynamic"] = rangeJson(row.voxels_dynamic);
    json["nodes_static"] = row.nodes_static;
    json["geometry_bytes_static"] = row.geometry_bytes_static;
    json["nodes_dynamic"] = rangeJson(row.nodes_dynamic);
    json["voxelize_ms"] = row.voxelize_ms;
    json["build_ms"] = row.build_ms;
    json["frames"] = row.frame_count;
    json["dynamic_voxelize_ms"] = spreadJson(row.dynamic_voxelize_ms);
    json["update_ms"] = spreadJson(row.update_ms);
    json["enlarged_grid_ms"] = row.enlarged_ms ? spreadJson(*row.enlarged_ms) : Json(nullptr);
    json["rebuild_ms"] = spreadJson(row.rebuild_ms);
    json["rebuild_moving_ms"] = spreadJson(row.rebuild_moving_ms);
    json["trace_merged_ms"] = spreadJson(row.trace_merged_ms);
    json["trace_rebuilt_ms"] = spreadJson(row.trace_rebuilt_ms);
    json["retries"] = row.retry_count;
    json["passes"] = passesJson(row.passes);
    return json;
}

class DynamicBench
{
public:
    DynamicBench(const BenchDynamicOptions& options, vk::HeadlessDevice& device)
        : m_options(options), m_device(device), m_tracer(device.device())
    {
        m_tracer.resize(kWidth, kHeight);
    }

    DynamicRow measure(const std::string& name, const AnimatedScene& animated, std::uint32_t depth, Progress& progress)
    {
        const Bounds bounds = boundsOverTime(animated);
        const Grid grid = gridOf(animated, bounds, depth);
        const ViewCamera view =
            chooseCamera(m_options.camera, animated, subjectOf(bounds, grid), double{kWidth} / kHeight);
        const TraceCamera camera = traceCamera(view, grid, kHeight);
        DynamicRow row;
        row.scene = name;
        row.resolution = grid.resolution();
        LiveScene live(m_device, AnimatedScene(animated), grid, liveOptions());
        const StaticInfo& fixed = live.info().fixed;
        row.triangles_static = fixed.triangle_count;
        row.triangles_dynamic = live.info().moving_triangle_count;
        row.voxels_static = fixed.voxel_count;
        row.nodes_static = fixed.node_count;
        row.geometry_bytes_static = fixed.geometry_bytes;
        row.voxelize_ms = operationMs(fixed.passes, "voxelize");
        row.build_ms = operationMs(fixed.passes, "octree");
        row.frame_count =
            static_cast<std::uint32_t>(std::max(1.0, std::round(animated.seconds * animated.frames_per_second)));
        measureFrames(animated, live, row, progress);
        measureRebuilds(animated, live, camera, row, progress);
        measureEnlarged(animated, grid, row, progress);
        return row;
    }

private:
    [[nodiscard]] LiveOptions liveOptions() const
    {
        return {m_options.coverage, m_options.attributes, m_options.structure};
    }

    // Measures each frame once, after an update that finds the room it needs.
    void measureFrames(const AnimatedScene& animated, LiveScene& live, DynamicRow& row, Progress& progress)
    {
        std::vector<double> voxelize_ms;
        std::vector<double> update_ms;
        warmUp(m_device, [&] { live.updateAndWait(frameTime(animated, row.frame_count - 1)); });
        for (std::uint32_t frame = 0; frame < row.frame_count; ++frame)
        {
            progress.begin(fmt::format("{} at {}: frame {}", row.scene, row.resolution, frame));
            const LiveUpdate update = live.updateAndWait(frameTime(animated, frame));
            row.retry_count += update.retry_count;
            if (update.retry_count != 0 && frame + 1 < row.frame_count)
            {
                continue; // the last attempt did not voxelize everything again
            }
            row.voxels_dynamic.add(update.report.dynamic_count);
            row.nodes_dynamic.add(update.report.node_count);
            voxelize_ms.push_back(0);
            update_ms.push_back(0);
            for (const vk::PassTime& pass : update.passes)
            {
                (voxelizesObjects(pass.name) ? voxelize_ms : update_ms).back() += pass.ms;
            }
            addPasses(row.passes, update.passes, row.frame_count);
        }
        row.dynamic_voxelize_ms = Spread::of(voxelize_ms);
        row.update_ms = Spread::of(update_ms);
    }

    // Measures rebuilds at times spread evenly over the animated scene. Pictures of both octrees are traced in turns.
    void measureRebuilds(const AnimatedScene& animated, LiveScene& live, const TraceCamera& camera, DynamicRow& row,
                         Progress& progress)
    {
        std::vector<double> rebuild_ms;
        std::vector<double> moving_ms;
        std::vector<double> rebuilt_trace_ms;
        std::vector<double> merged_trace_ms;
        const Grid grid = live.tree().grid;
        AnimatedScene moving;
        moving.objects = animated.objects;
        BuildOptions build;
        build.coverage = m_options.coverage;
        build.attributes = m_options.attributes;
        BuildOptions moving_build = build;
        const auto rebuild = [&](const AnimatedScene& what, std::uint32_t frame, BuildOptions& options)
        {
            const GpuScene scene = uploadScene(m_device, sceneAt(what, frameTime(animated, frame)),
                                               m_options.attributes, brightestEmission(animated));
            BuildResult built = buildOctree(m_device, scene, grid, options);
            options.capacities = built.capacities; // warm from the second time on
            return built;
        };
        rebuild(animated, 0, build);
        rebuild(moving, 0, moving_build);
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            progress.begin(fmt::format("{} at {}: rebuild {}", row.scene, row.resolution, run));
            const std::uint32_t frame = run * row.frame_count / m_options.run_count;
            const BuildResult built = rebuild(animated, frame, build);
            rebuild_ms.push_back(sumMs(built.passes));
            live.updateAndWait(frameTime(animated, frame));
            for (std::uint32_t turn = 0; turn < kTraceTurns; ++turn)
            {
                merged_trace_ms.push_back(traceMs(live.tree(), camera));
                rebuilt_trace_ms.push_back(traceMs(built.octree, camera));
            }
            moving_ms.push_back(sumMs(rebuild(moving, frame, moving_build).passes));
        }
        row.rebuild_moving_ms = Spread::of(moving_ms);
        row.rebuild_ms = Spread::of(rebuild_ms);
        row.trace_merged_ms = Spread::of(merged_trace_ms);
        row.trace_rebuilt_ms = Spread::of(rebuilt_trace_ms);
    }

    // Measures some frames in a grid four times as large, with voxels of the same size.
    void measureEnlarged(const AnimatedScene& animated, Grid grid, DynamicRow& row, Progress& progress)
    {
        grid.depth += 2;
        if (grid.depth > Grid::kDepthMax)
        {
            return;
        }
        LiveScene live(m_device, AnimatedScene(animated), grid, liveOptions());
        std::vector<double> enlarged_ms;
        live.updateAndWait(frameTime(animated, row.frame_count - 1));
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            progress.begin(fmt::format("{} in {}: update {}", row.scene, grid.resolution(), run));
            const std::uint32_t frame = run * row.frame_count / m_options.run_count;
            enlarged_ms.push_back(sumMs(live.updateAndWait(frameTime(animated, frame)).passes));
        }
        row.enlarged_ms = Spread::of(enlarged_ms);
    }

    // Time of the node paths, the beam and primary rays.
    double traceMs(const DeviceTree& tree, const TraceCamera& camera)
    {
        m_tracer.forget();
        return sumMs(
            m_device.run([&](vk::FrameGraph& graph) { m_tracer.tracePrimary(graph, tree, camera, TraceOptions{}); }));
    }

    const BenchDynamicOptions& m_options;
    vk::HeadlessDevice& m_device;
    TreeTracer m_tracer;
};

std::string tableHead(const vk::DeviceReport& device, std::uint32_t run_count)
{
    return fmt::format("zvo {} on {} ({}, {}). GPU milliseconds: median (min-max), of all frames or, for rebuilds, "
                       "pictures and the larger grid, of {}. "
                       "Trace: node paths, beam and primary rays, {}x{}.\n\n",
                       ZVO_VERSION_TEXT, device.name, device.type, device.driver, run_count, kWidth, kHeight) +
           columnNames(columns());
}

Json reportJson(const vk::DeviceReport& device, const BenchDynamicOptions& options, const std::vector<DynamicRow>& rows)
{
    Json json = headJson("zvo.bench_dynamic/1", device);
    json["width"] = kWidth;
    json["height"] = kHeight;
    json["coverage"] = coverageName(options.coverage);
    json["attributes"] = options.attributes ? "full" : "none";
    json["structure"] = structureName(options.structure);
    json["rebuilds"] = options.run_count;
    json["rows"] = Json::array();
    for (const DynamicRow& row : rows)
    {
        json["rows"].push_back(rowJson(row));
    }
    return json;
}

} // namespace

void benchDynamic(const BenchDynamicOptions& options)
{
    std::optional<Output> report = openReport(options.output);
    std::vector<AnimatedScene> scenes;
    std::size_t operation_count = 0;
    for (const std::filesystem::path& path : options.scenes)
    {
        scenes.push_back(loadSceneFile(options, path));
        operation_count +=
            static_cast<std::size_t>(scenes.back().seconds * scenes.back().frames_per_second) + 2 * options.run_count;
    }
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    Output table("-", true);
    const bool show_table = options.output.json != "-";
    if (show_table)
    {
        table.write(tableHead(device.device().report(), options.run_count));
    }
    DynamicBench measurements(options, device);
    std::vector<DynamicRow> rows;
    Progress progress(operation_count * options.depths.value_or(std::vector{kDepth}).size());
    for (std::size_t i = 0; i < scenes.size(); ++i)
    {
        const std::string name = options.scenes[i].stem().stem().string();
        for (const std::uint32_t depth : options.depths.value_or(std::vector{scenes[i].grid_depth.value_or(kDepth)}))
        {
            rows.push_back(measurements.measure(name, scenes[i], depth, progress));
            if (show_table)
            {
                clearProgressBar();
                table.write(columnValues(columns(), rows.back()));
            }
        }
    }
    if (show_table && options.passes)
    {
        for (const DynamicRow& row : rows)
        {
            table.write(passTable(row.scene, row.resolution, row.passes));
        }
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, reportJson(device.device().report(), options, rows));
    }
}

} // namespace zvo::cli
