// SPDX-License-Identifier: MIT
#include "bench/bench_solid.h"

#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/bench_trace.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/view.h"
#include "core/base/kernels.h"
#include "runtime/distances.h"
#include "runtime/run_job.h"
#include "runtime/tree_algebra.h"
#include "runtime/trees.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kSolidDepth = 9;
constexpr std::uint32_t kBand = 3; // voxels
constexpr std::uint32_t kWidth = 1920;
constexpr std::uint32_t kHeight = 1080;

struct SolidRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::string work;
    std::uint64_t voxels = 0; // of the result
    Spread ms;
    std::optional<Spread> ratio; // to the same for the surface, in turns
};

double sumOf(const std::vector<vk::PassTime>& passes)
{
    double ms = 0;
    for (const vk::PassTime& pass : passes)
    {
        ms += pass.ms;
    }
    return ms;
}

// Measures what is made of one scene at one resolution.
class SolidRuns
{
public:
    SolidRuns(vk::HeadlessDevice& device, const BenchSolidOptions& options, const Scene& scene, const Grid& grid,
              std::string name)
        : m_device(device), m_options(options), m_scene(scene), m_grid(grid), m_name(std::move(name)),
          m_uploaded(uploadScene(device, scene, options.attributes)), m_tables(uploadColorTables(device))
    {
    }

    std::vector<SolidRow> run()
    {
        builds();
        rays();
        const DeviceTree eroded = applyAlgebra(m_device, {.operation = TreeOperation::Erode}, m_solid);
        algebra("dilate", {.operation = TreeOperation::Dilate}, m_solid, nullptr);
        algebra("erode", {.operation = TreeOperation::Erode}, m_solid, nullptr);
        algebra("union", {.operation = TreeOperation::Unite}, m_solid, &eroded);
        algebra("difference", {.operation = TreeOperation::Subtract}, m_solid, &eroded);
        algebra("largest component", {.operation = TreeOperation::Keep, .corners = true, .largest = 1}, m_surface,
                nullptr);
        algebra("enclose", {.operation = TreeOperation::Enclose}, m_surface, nullptr);
        distances();
        return std::move(m_rows);
    }

private:
    void add(std::string work, std::uint64_t voxels, const std::function<double()>& measure)
    {
        warmUp(m_device, measure);
        std::vector<double> times;
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            times.push_back(measure());
        }
        m_rows.push_back({m_name, m_grid.resolution(), std::move(work), voxels, Spread::of(times), std::nullopt});
    }

    // Surface and solid in turns.
    void builds()
    {
        const auto build = [this](Fill fill, DeviceTree& tree)
        {
            BuildResult built =
                buildOctree(m_device, m_uploaded, m_grid,
                            {.coverage = m_options.coverage, .attributes = m_options.attributes, .fill = fill});
            tree = std::move(built.octree);
            return sumOf(built.passes);
        };
        warmUp(m_device, [&] { build(Fill::Solid, m_solid); });
        std::vector<double> surface;
        std::vector<double> solid;
        std::vector<double> ratios;
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            surface.push_back(build(Fill::None, m_surface));
            solid.push_back(build(Fill::Solid, m_solid));
            ratios.push_back(solid.back() / surface.back());
        }
        m_rows.push_back({m_name, m_grid.resolution(), "build the surface", m_surface.occupiedCount(),
                          Spread::of(surface), std::nullopt});
        m_rows.push_back({m_name, m_grid.resolution(), "build and fill", m_solid.occupiedCount(), Spread::of(solid),
                          Spread::of(ratios)});
    }

    void rays()
    {
        const Bounds bounds = subjectOf(m_scene.bounds(), m_grid);
        const ViewCamera view = chooseCamera("", m_scene, bounds, double{kWidth} / kHeight);
        const TraceCamera camera = traceCamera(view, m_grid, kHeight);
        TreeTracer tracer(m_device.device());
        tracer.resize(kWidth, kHeight);
        PrimaryRays surface(m_device, m_surface, camera, tracer);
        PrimaryRays solid(m_device, m_solid, camera, tracer);
        const TraceRuns runs = traceInTurns(surface, solid, kTraceTurns * m_options.run_count);
        m_rows.push_back({m_name, m_grid.resolution(), "primary rays, surface", m_surface.occupiedCount(),
                          runs.octree_ms, std::nullopt});
        m_rows.push_back(
            {m_name, m_grid.resolution(), "primary rays, filled", m_solid.occupiedCount(), runs.dag_ms, runs.ratio});
    }

    void algebra(const char* work, const AlgebraInfo& info, const DeviceTree& a, const DeviceTree* b)
    {
        std::uint64_t voxels = 0;
        const auto calculate = [&]
        {
            AlgebraJob job(m_device.device(), m_tables, info, a, b);
            const double ms = sumOf(runSteps(m_device, job));
            voxels = job.take().occupiedCount();
            return ms;
        };
        add(work, 0, calculate);
        m_rows.back().voxels = voxels;
    }

    void distances()
    {
        const GpuScene bare = uploadScene(m_device, m_scene, false);
        std::uint64_t leaves = 0;
        add(fmt::format("distances to {} voxels", kBand), 0,
            [&]
            {
                const DistanceResult found = findDistances(m_device, bare, m_grid, {.band = kBand});
                leaves = found.distances.leaf_count;
                return sumOf(found.passes);
            });
        constexpr std::uint64_t kLeafVoxels = 64;
        m_rows.back().voxels = leaves * kLeafVoxels;
    }

    vk::HeadlessDevice& m_device;
    const BenchSolidOptions& m_options;
    const Scene& m_scene;
    Grid m_grid;
    std::string m_name;
    GpuScene m_uploaded;
    GpuScene m_tables;
    DeviceTree m_surface;
    DeviceTree m_solid;
    std::vector<SolidRow> m_rows;
};

const Columns<SolidRow>& solidColumns()
{
    static const Columns<SolidRow> all = {
        {"scene", 12, [](const SolidRow& row) { return row.scene; }},
        {"resolution", 10, [](const SolidRow& row) { return fmt::format("{}", row.resolution); }},
        {"work", 22, [](const SolidRow& row) { return row.work; }},
        {"voxels", 11, [](const SolidRow& row) { return fmt::format("{}", row.voxels); }},
        {"ms", 23, [](const SolidRow& row) { return spreadText(row.ms); }},
        {"to surface", 16, [](const SolidRow& row) { return cellText(row.ratio); }},
    };
    return all;
}

Json solidJson(const vk::DeviceReport& device, const BenchSolidOptions& options, const std::vector<SolidRow>& rows)
{
    Json json = headJson("zvo.bench_solid/1", device);
    json["runs"] = options.run_count;
    json["rows"] = Json::array();
    for (const SolidRow& row : rows)
    {
        Json one = {{"scene", row.scene},
                    {"resolution", row.resolution},
                    {"work", row.work},
                    {"voxels", row.voxels},
                    {"ms", spreadJson(row.ms)}};
        if (row.ratio)
        {
            one["ratio"] = spreadJson(*row.ratio);
        }
        json["rows"].push_back(std::move(one));
    }
    return json;
}

} // namespace

void benchSolid(const BenchSolidOptions& options)
{
    const std::vector<std::filesystem::path> paths = benchScenes(options);
    const std::vector<std::uint32_t> depths = options.depths.value_or(std::vector{kSolidDepth});
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::vector<SolidRow> rows;
    Progress progress(paths.size() * depths.size());
    for (const std::filesystem::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        for (const std::uint32_t depth : depths)
        {
            const std::string name = path.stem().string();
            const Grid grid = Grid::around(scene.bounds(), depth, kBand + 1);
            progress.begin(fmt::format("{} at {}", name, grid.resolution()));
            std::vector<SolidRow> more = SolidRuns(device, options, scene, grid, name).run();
            std::ranges::move(more, std::back_inserter(rows));
        }
    }
    clearProgressBar();
    if (options.output.json != "-")
    {
        std::string text = fmt::format("zvo {} on {} ({}, {}). GPU milliseconds: median (min-max) of {} runs. Surface "
                                       "and filled in turns, ratio of neighbours.\n\n{}",
                                       ZVO_VERSION_TEXT, device.device().report().name, device.device().report().type,
                                       device.device().report().driver, options.run_count, columnNames(solidColumns()));
        for (const SolidRow& row : rows)
        {
            text += columnValues(solidColumns(), row);
        }
        Output("-", true).write(text);
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, solidJson(device.device().report(), options, rows));
    }
}

} // namespace zvo::cli
