// SPDX-License-Identifier: MIT
#include "bench/bench_tune.h"

#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/bench_table.h"
#include "bench/bench_trace.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/view.h"
#include "core/base/kernels.h"
#include "core/base/lanes.h"
#include "core/base/tuning.h"
#include "core/path/daylight.h"
#include "core/path/path_tracer.h"
#include "core/trace/tree_tracer.h"
#include "core/upload/gpu_scene.h"
#include "runtime/distances.h"
#include "runtime/trees.h"
#include "zvo/error.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kTuneDepth = 8;
constexpr double kGainMin = 0.03; // of time, for which another value is worth a word

/// One value of a choice, measured.
struct TuneRow
{
    const TuningRow* choice;
    TuningValue value;
    Spread ms;
    Spread ratio; // to the table's value, of runs in turns
    bool is_tables = false;
    bool is_advised = false;
};

const Columns<TuneRow>& tuneColumns()
{
    using Row = TuneRow;
    static const Columns<Row> all = {
        {"choice", 13, [](const Row& row) { return std::string(row.choice->name); }},
        {"value", 9, [](const Row& row) { return std::string(row.value.name); }},
        {"ms", 21, [](const Row& row) { return spreadText(row.ms); }},
        {"ratio", 5, [](const Row& row) { return fmt::format("{:.2f}", row.ratio.median); }},
        {"", 12,
         [](const Row& row) {
             return std::string(row.is_advised ? "faster" : row.is_tables ? "zvo's choice" : "");
         }},
    };
    return all;
}

/// A device on which one value of a choice holds, and what is measured there.
class TunedDevice
{
public:
    TunedDevice(const BenchTuneOptions& options, const Scene& scene, vk::TuningValues tuning)
        : m_options(options), m_device(deviceOptions(options, std::move(tuning)), zvoKernels()),
          m_scene(uploadScene(m_device, scene, options.attributes, brightestEmission(scene))),
          m_grid(Grid::around(scene.bounds(), options.depths.value_or(std::vector{kTuneDepth}).front())),
          m_view(chooseCamera(options.camera, scene, subjectOf(scene.bounds(), m_grid),
                              static_cast<double>(options.width) / options.height)),
          m_sky(m_device.device()), m_tracer(m_device.device()), m_paths(m_device.device())
    {
        m_sky.setSun(daylight());
        m_tracer.resize(options.width, options.height);
        m_paths.resize(options.width, options.height);
    }

    [[nodiscard]] vk::HeadlessDevice& device() { return m_device; }

    /// Runs what the choice is about once, and returns its time.
    double measure(Tunable tunable)
    {
        switch (tunable)
        {
        case Tunable::NodeLanes:
            return msOf(build(), {"octree/average"});
        case Tunable::BlockLanes:
            return msOf(build(), {"voxelize/bin_large"});
        case Tunable::BrickLanes:
            return msOf(build(), {"voxelize/collect_bricks", "voxelize/brick_leaves"});
        case Tunable::BandLanes:
            return msOf(findDistances(m_device, m_scene, m_grid, {.band = 1}).passes, {"distance/measure"});
        case Tunable::MixedSums:
            return sumMs(build());
        case Tunable::PathForm:
            return sumMs(paths());
        case Tunable::BeamLanes:
            return msOf(picture(), {"trace/beam"});
        case Tunable::SubgroupSize:
        case Tunable::Loads:
            return sumMs(build()) + sumMs(picture()) + sumMs(paths());
        }
        return 0;
    }

private:
    static vk::HeadlessOptions deviceOptions(const BenchTuneOptions& options, vk::TuningValues tuning)
    {
        vk::HeadlessOptions headless = headlessOptions(options.device);
        headless.tuning = std::move(tuning);
        return headless;
    }

    // The time of the passes whose names begin with one of these.
    static double msOf(const std::vector<vk::PassTime>& passes, std::initializer_list<std::string_view> names)
    {
        double ms = 0;
        for (const vk::PassTime& pass : passes)
        {
            const auto begins = [&](std::string_view name) { return pass.name.starts_with(name); };
            ms += std::ranges::any_of(names, begins) ? pass.ms : 0;
        }
        return ms;
    }

    std::vector<vk::PassTime> build()
    {
        BuildOptions options{m_options.coverage, m_options.attributes, m_capacities};
        m_built = {}; // frees its memory before the next one is made
        m_built = buildOctree(m_device, m_scene, m_grid, options);
        m_capacities = m_built.capacities;
        return m_built.passes;
    }

    void buildOnce()
    {
        if (m_built.octree.voxel_count == 0)
        {
            build();
        }
    }

    std::vector<vk::PassTime> picture()
    {
        buildOnce();
        const TraceCamera camera = traceCamera(m_view, m_grid, m_options.height);
        return m_device.run([&](vk::FrameGraph& graph) { m_tracer.trace(graph, m_built.octree, camera, {}); });
    }

    std::vector<vk::PassTime> paths()
    {
        buildOnce();
        const TraceCamera camera = traceCamera(m_view, m_grid, m_options.height);
        return m_device.run([&](vk::FrameGraph& graph)
                            { m_paths.addSample(graph, m_built.octree, m_sky, camera, PathOptions()); });
    }

    const BenchTuneOptions& m_options;
    vk::HeadlessDevice m_device;
    GpuScene m_scene;
    Grid m_grid;
    ViewCamera m_view;
    DeviceEnvironment m_sky;
    TreeTracer m_tracer;
    PathTracer m_paths;
    std::optional<VoxelizeCapacities> m_capacities;
    BuildResult m_built;
};

// Whether kernels that get this value run with it, and not with the nearest one that the device, or another choice,
// allows.
bool canHave(const vk::Device& device, Tunable tunable, std::uint32_t value)
{
    const vk::DeviceReport& report = device.report();
    switch (tunable)
    {
    case Tunable::NodeLanes:
        return value <= lanesMax(device);
    case Tunable::BeamLanes:
        return value <= beamLanesMax(device);
    case Tunable::SubgroupSize:
        return value == 0 || (report.min_subgroup_size != 0 && value >= report.min_subgroup_size &&
                              value <= report.max_subgroup_size);
    case Tunable::BlockLanes:
    case Tunable::BrickLanes:
    case Tunable::BandLanes:
    case Tunable::MixedSums:
    case Tunable::PathForm:
    case Tunable::Loads:
        break;
    }
    return true;
}

/// Measures the values of one choice in turns, each on a device of its own.
std::vector<TuneRow> measureChoice(const BenchTuneOptions& options, const Scene& scene, const vk::Device& device,
                                   const TuningRow& choice)
{
    std::uint32_t tables = tunedValue(device, choice.tunable);
    tables = canHave(device, choice.tunable, tables) ? tables : choice.values.front().value;
    std::vector<TuneRow> rows;
    std::vector<std::unique_ptr<TunedDevice>> devices;
    std::size_t first = 0; // the table's
    for (const TuningValue& value : choice.values)
    {
        if (canHave(device, choice.tunable, value.value))
        {
            const vk::TuningValues tuning = {{std::string(choice.name), value.value}};
            devices.push_back(std::make_unique<TunedDevice>(options, scene, tuning));
            devices.back()->measure(choice.tunable); // makes kernels
            first = value.value == tables ? rows.size() : first;
            rows.push_back(
                {.choice = &choice, .value = value, .ms = {}, .ratio = {}, .is_tables = value.value == tables});
        }
    }
    warmUp(devices.back()->device(), [&] { devices.back()->measure(choice.tunable); });
    std::vector<std::vector<double>> ms(rows.size());
    std::vector<std::vector<double>> ratios(rows.size());
    for (std::uint32_t run = 0; run < options.run_count; ++run)
    {
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            ms[i].push_back(devices[i]->measure(choice.tunable));
        }
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            ratios[i].push_back(ms[first].back() > 0 ? ms[i].back() / ms[first].back() : 1.0);
        }
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        rows[i].ms = Spread::of(ms[i]);
        rows[i].ratio = Spread::of(ratios[i]);
        checkValidation(devices[i]->device());
    }
    const auto best = std::ranges::min_element(rows, {}, [](const TuneRow& row) { return row.ratio.median; });
    best->is_advised = best->ratio.median < 1 - kGainMin && best->ratio.max < 1;
    return rows;
}

vk::TuningValues adviceOf(const std::vector<TuneRow>& rows)
{
    vk::TuningValues advice;
    for (const TuneRow& row : rows)
    {
        if (row.is_advised)
        {
            advice.emplace(row.choice->name, row.value.value);
        }
    }
    return advice;
}

std::string tuneText(const vk::DeviceReport& device, const BenchTuneOptions& options, const std::string& scene,
                     std::uint32_t resolution, const std::vector<TuneRow>& rows)
{
    std::string text = fmt::format(
        "zvo {} on {} ({}, {}), {} at {}, {} x {} pixels. GPU milliseconds of the passes that a choice is about, "
        "medians of {} runs; ratios to zvo's choice, in turns. Faster is what was faster in every run. Choices are "
        "measured one at a "
        "time: measure again with both of two that touch the same passes.\n\n{}",
        ZVO_VERSION_TEXT, device.name, device.type, device.driver, scene, resolution, options.width, options.height,
        options.run_count, columnNames(tuneColumns()));
    for (const TuneRow& row : rows)
    {
        text += columnValues(tuneColumns(), row);
    }
    const vk::TuningValues advice = adviceOf(rows);
    text += advice.empty() ? fmt::format("\nNothing is faster than zvo's choices by {:.0f} %.\n", 100 * kGainMin)
                           : fmt::format("\n--tuning {}\n", tuningText(advice));
    return text;
}

Json tuneJson(const vk::DeviceReport& device, const BenchTuneOptions& options, const std::string& scene,
              std::uint32_t resolution, const std::vector<TuneRow>& rows)
{
    Json json = headJson("zvo.bench_tune/1", device);
    json["scene"] = scene;
    json["resolution"] = resolution;
    json["runs"] = options.run_count;
    json["width"] = options.width;
    json["height"] = options.height;
    json["rows"] = Json::array();
    for (const TuneRow& row : rows)
    {
        json["rows"].push_back({{"choice", row.choice->name},
                                {"value", row.value.name},
                                {"ms", spreadJson(row.ms)},
                                {"ratio", spreadJson(row.ratio)},
                                {"is_default", row.is_tables},
                                {"is_advised", row.is_advised}});
    }
    json["tuning"] = tuningText(adviceOf(rows));
    return json;
}

} // namespace

void benchTune(const BenchTuneOptions& options)
{
    const std::filesystem::path path = benchScenes(options).back();
    const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice untuned(headlessOptions(options.device), zvoKernels());
    const vk::DeviceReport& device = untuned.device().report();
    std::vector<TuneRow> rows;
    Progress progress(tuningTable().size());
    for (const TuningRow& choice : tuningTable())
    {
        progress.begin(choice.meaning);
        const std::vector<TuneRow> measured = measureChoice(options, scene, untuned.device(), choice);
        rows.insert(rows.end(), measured.begin(), measured.end());
    }
    clearProgressBar();
    const std::string name = path.stem().string();
    const std::uint32_t resolution = 1U << options.depths.value_or(std::vector{kTuneDepth}).front();
    if (options.output.json != "-")
    {
        Output("-", true).write(tuneText(device, options, name, resolution, rows));
    }
    if (report)
    {
        writeReport(*report, tuneJson(device, options, name, resolution, rows));
    }
}

} // namespace zvo::cli
