// SPDX-License-Identifier: MIT
#include "bench/bench_balance.h"

#include "bench/balance_scenes.h"
#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "core/upload/gpu_scene.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

struct GeneratedScene
{
    const char* name;
    Scene (*make)(std::uint32_t resolution);
    bool grows; // at twice the resolution it has four times the voxels
};

constexpr std::array kGeneratedScenes = {
    GeneratedScene{"triangle", largeTriangle, true},   GeneratedScene{"patch", smallTriangles, true},
    GeneratedScene{"slivers", diagonalSlivers, false}, GeneratedScene{"crowded", crowdedTriangles, false},
    GeneratedScene{"spread", spreadTriangles, false},  GeneratedScene{"brick", brickTriangles, false},
    GeneratedScene{"fan", fanOfSlivers, false},        GeneratedScene{"boxes", manyBoxes, false}};

/// One scene at one resolution: milliseconds of voxelization and octree construction.
struct BalanceRow
{
    std::string scene;
    std::size_t subject = 0; // number of the scene, the same at all resolutions
    std::uint32_t resolution = 0;
    std::uint64_t triangles = 0;
    std::uint64_t voxels = 0;
    Spread geometry_ms;                  // without attributes
    std::optional<Spread> attributes_ms; // with attributes, if these were asked for
    bool generated = false;
    bool grows = true;

    [[nodiscard]] double nsPerVoxel(double ms) const
    {
        return voxels == 0 ? 0.0 : ms * 1e6 / static_cast<double>(voxels);
    }
};

/// The ratio of the times of two rows, in all or per voxel.
struct BalanceRatio
{
    std::string name;
    std::string scene; // or two scenes
    std::uint32_t resolution = 0;
    double geometry = 0;
    std::optional<double> attributes;
};

const Columns<BalanceRow>& columns()
{
    const auto orDash = [](const BalanceRow& row, auto text)
    { return row.attributes_ms ? text(*row.attributes_ms) : std::string("-"); };
    const auto ns = [](const BalanceRow& row, const Spread& spread)
    { return fmt::format("{:.1f}", row.nsPerVoxel(spread.median)); };
    static const Columns<BalanceRow> all = {
        {"scene", 12, [](const BalanceRow& row) { return row.scene; }},
        {"resolution", 10, [](const BalanceRow& row) { return fmt::format("{}", row.resolution); }},
        {"triangles", 9, [](const BalanceRow& row) { return fmt::format("{}", row.triangles); }},
        {"voxels", 9, [](const BalanceRow& row) { return fmt::format("{}", row.voxels); }},
        {"geometry ms", 23, [](const BalanceRow& row) { return spreadText(row.geometry_ms); }},
        {"ns/voxel", 10, [ns](const BalanceRow& row) { return ns(row, row.geometry_ms); }},
        {"with attributes ms", 23, [orDash](const BalanceRow& row) { return orDash(row, spreadText); }},
        {"ns/voxel", 10,
         [=](const BalanceRow& row) { return orDash(row, [&](const Spread& spread) { return ns(row, spread); }); }},
    };
    return all;
}

const Columns<BalanceRatio>& ratioColumns()
{
    static const Columns<BalanceRatio> all = {
        {"ratio", 16, [](const BalanceRatio& ratio) { return ratio.name; }},
        {"scenes", 20, [](const BalanceRatio& ratio) { return ratio.scene; }},
        {"resolution", 10, [](const BalanceRatio& ratio) { return fmt::format("{}", ratio.resolution); }},
        {"geometry", 8, [](const BalanceRatio& ratio) { return fmt::format("{:.2f}", ratio.geometry); }},
        {"with attributes", 15,
         [](const BalanceRatio& ratio)
         { return ratio.attributes ? fmt::format("{:.2f}", *ratio.attributes) : std::string("-"); }},
    };
    return all;
}

double quotient(double a, double b)
{
    return b > 0 ? a / b : 0.0;
}

// The ratio of the times of a and b, per voxel or in all.
BalanceRatio ratioOf(const std::string& name, const BalanceRow& a, const BalanceRow& b, bool per_voxel)
{
    const auto of = [&](const Spread& x, const Spread& y)
    { return per_voxel ? quotient(a.nsPerVoxel(x.median), b.nsPerVoxel(y.median)) : quotient(x.median, y.median); };
    BalanceRatio ratio;
    ratio.name = name;
    ratio.scene = a.scene == b.scene ? a.scene : a.scene + " / " + b.scene;
    ratio.resolution = a.resolution;
    ratio.geometry = of(a.geometry_ms, b.geometry_ms);
    if (a.attributes_ms && b.attributes_ms)
    {
        ratio.attributes = of(*a.attributes_ms, *b.attributes_ms);
    }
    return ratio;
}

double worst(const BalanceRatio& ratio)
{
    return std::max(ratio.geometry, ratio.attributes.value_or(0.0));
}

// The ratio of the most to the least time per voxel, among files at one resolution.
std::optional<BalanceRatio> slowestOverFastest(const std::vector<BalanceRow>& rows, std::uint32_t resolution)
{
    std::optional<BalanceRatio> largest;
    for (const BalanceRow& a : rows)
    {
        for (const BalanceRow& b : rows)
        {
            const bool counts = !a.generated && !b.generated && a.resolution == resolution &&
                                b.resolution == resolution && a.subject != b.subject && a.voxels != 0 && b.voxels != 0;
            const BalanceRatio ratio = ratioOf("scene / scene", a, b, true);
            if (counts && (!largest || worst(ratio) > worst(*largest)))
            {
                largest = ratio;
            }
        }
    }
    return largest;
}

// The ratios of times at twice the resolution.
std::vector<BalanceRatio> doublings(const std::vector<BalanceRow>& rows)
{
    std::vector<BalanceRatio> ratios;
    for (const BalanceRow& a : rows)
    {
        const auto half = std::find_if(rows.begin(), rows.end(),
                                       [&](const BalanceRow& b)
                                       { return b.subject == a.subject && a.resolution == 2 * b.resolution; });
        if (a.grows && half != rows.end())
        {
            ratios.push_back(ratioOf("doubling", a, *half, false));
        }
    }
    return ratios;
}

std::vector<BalanceRatio> ratiosOf(const std::vector<BalanceRow>& rows, const std::vector<std::uint32_t>& depths)
{
    std::vector<BalanceRatio> ratios;
    for (const std::uint32_t depth : depths)
    {
        const std::uint32_t resolution = 1U << depth;
        const auto row = [&](const std::string& scene) -> const BalanceRow&
        {
            return *std::find_if(rows.begin(), rows.end(),
                                 [&](const BalanceRow& r)
                                 { return r.generated && r.scene == scene && r.resolution == resolution; });
        };
        ratios.push_back(ratioOf("triangle / patch", row("triangle"), row("patch"), true));
        ratios.push_back(ratioOf("sliver / patch", row("slivers"), row("patch"), true));
        ratios.push_back(ratioOf("fan / patch", row("fan"), row("patch"), true));
        ratios.push_back(ratioOf("boxes / patch", row("boxes"), row("patch"), true));
        ratios.push_back(ratioOf("crowded / spread", row("crowded"), row("spread"), false));
        ratios.push_back(ratioOf("brick / spread", row("brick"), row("spread"), false));
        if (std::optional<BalanceRatio> scenes = slowestOverFastest(rows, resolution))
        {
            ratios.push_back(*std::move(scenes));
        }
    }
    const std::vector<BalanceRatio> doubled = doublings(rows);
    ratios.insert(ratios.end(), doubled.begin(), doubled.end());
    if (!doubled.empty())
    {
        const auto less = [](const BalanceRatio& a, const BalanceRatio& b) { return worst(a) < worst(b); };
        ratios.push_back(*std::max_element(doubled.begin(), doubled.end(), less));
        ratios.back().name = "largest doubling";
    }
    return ratios;
}

std::string tableHead(const vk::DeviceReport& device, const BenchBalanceOptions& options)
{
    return fmt::format("zvo {} on {} ({}, {}), {} coverage. Voxelization and octree construction, GPU milliseconds: "
                       "median (min-max) of {} warm {}.\n\n",
                       ZVO_VERSION_TEXT, device.name, device.type, device.driver, coverageName(options.coverage),
                       options.run_count, options.run_count == 1 ? "run" : "runs") +
           columnNames(columns());
}

std::string ratioTable(const std::vector<BalanceRatio>& ratios)
{
    std::string table = "\nRatios of times a voxel; those to spread and doubling (to this resolution) of whole "
                        "times:\n\n" +
                        columnNames(ratioColumns());
    for (const BalanceRatio& ratio : ratios)
    {
        table += columnValues(ratioColumns(), ratio);
    }
    return table;
}

Json rowJson(const BalanceRow& row)
{
    Json json;
    json["scene"] = row.scene;
    json["generated"] = row.generated;
    json["resolution"] = row.resolution;
    json["triangles"] = row.triangles;
    json["voxels"] = row.voxels;
    json["geometry_ms"] = spreadJson(row.geometry_ms);
    json["geometry_ns_per_voxel"] = row.nsPerVoxel(row.geometry_ms.median);
    json["attributes_ms"] = row.attributes_ms ? spreadJson(*row.attributes_ms) : Json(nullptr);
    json["attributes_ns_per_voxel"] =
        row.attributes_ms ? Json(row.nsPerVoxel(row.attributes_ms->median)) : Json(nullptr);
    return json;
}

Json balanceJson(const vk::DeviceReport& device, const BenchBalanceOptions& options,
                 const std::vector<BalanceRow>& rows, const std::vector<BalanceRatio>& ratios)
{
    Json json = headJson("zvo.balance/1", device);
    json["coverage"] = coverageName(options.coverage);
    json["runs"] = options.run_count;
    json["rows"] = Json::array();
    for (const BalanceRow& row : rows)
    {
        json["rows"].push_back(rowJson(row));
    }
    json["ratios"] = Json::array();
    for (const BalanceRatio& ratio : ratios)
    {
        json["ratios"].push_back({{"name", ratio.name},
                                  {"scenes", ratio.scene},
                                  {"resolution", ratio.resolution},
                                  {"geometry", ratio.geometry},
                                  {"attributes", ratio.attributes ? Json(*ratio.attributes) : Json(nullptr)}});
    }
    return json;
}

class BalanceBench
{
public:
    /// show: called with every row.
    BalanceBench(const BenchBalanceOptions& options, const std::vector<std::uint32_t>& depths,
                 vk::HeadlessDevice& device, std::function<void(const BalanceRow&)> show)
        : m_options(options), m_depths(depths), m_device(device), m_show(std::move(show))
    {
    }

    std::vector<BalanceRow> measure(const std::vector<fs::path>& paths)
    {
        Progress progress((kGeneratedScenes.size() + paths.size()) * m_depths.size());
        for (const GeneratedScene& generated : kGeneratedScenes)
        {
            measureGenerated(generated, progress);
            ++m_subject;
        }
        for (const fs::path& path : paths)
        {
            measureFile(path, progress);
            ++m_subject;
        }
        return std::move(m_rows);
    }

private:
    void measureGenerated(const GeneratedScene& generated, Progress& progress)
    {
        for (const std::uint32_t depth : m_depths)
        {
            const Scene scene = generated.make(1U << depth);
            const GpuScene gpu_scene = uploadScene(m_device, scene, m_options.attributes);
            BalanceRow row;
            row.scene = generated.name;
            row.generated = true;
            row.grows = generated.grows;
            addRow(std::move(row), scene, gpu_scene, {glm::vec3(0.0F), 1.0F, depth}, progress);
        }
    }

    void measureFile(const fs::path& path, Progress& progress)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), m_options.load);
        const GpuScene gpu_scene = uploadScene(m_device, scene, m_options.attributes);
        for (const std::uint32_t depth : m_depths)
        {
            BalanceRow row;
            row.scene = path.stem().string();
            addRow(std::move(row), scene, gpu_scene, Grid::around(scene.bounds(), depth), progress);
        }
    }

    void addRow(BalanceRow row, const Scene& scene, const GpuScene& gpu_scene, const Grid& grid, Progress& progress)
    {
        row.subject = m_subject;
        row.resolution = grid.resolution();
        row.triangles = scene.triangleCount();
        progress.begin(fmt::format("{} at {}", row.scene, row.resolution));
        if (m_options.attributes)
        {
            row.attributes_ms =
                measureBuild(m_device, gpu_scene, grid, {m_options.coverage, true, {}}, m_options.run_count).total_ms;
        }
        const BuildRuns geometry =
            measureBuild(m_device, gpu_scene, grid, {m_options.coverage, false, {}}, m_options.run_count);
        row.geometry_ms = geometry.total_ms;
        row.voxels = geometry.last.octree.voxel_count;
        clearProgressBar();
        m_show(row);
        m_rows.push_back(std::move(row));
    }

    const BenchBalanceOptions& m_options;
    const std::vector<std::uint32_t>& m_depths;
    vk::HeadlessDevice& m_device;
    std::function<void(const BalanceRow&)> m_show;
    std::vector<BalanceRow> m_rows;
    std::size_t m_subject = 0;
};

} // namespace

void benchBalance(const BenchBalanceOptions& options)
{
    std::vector<fs::path> paths;
    if (!options.scenes.empty() || options.scene_folder)
    {
        paths = benchScenes(options);
    }
    const std::vector<std::uint32_t> depths = options.depths.value_or(std::vector{9U, 10U, 11U});
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    Output table("-", true);
    const bool show_table = options.output.json != "-";
    const auto show = [&](const std::string& text)
    {
        if (show_table)
        {
            table.write(text);
        }
    };
    show(tableHead(device.device().report(), options));
    BalanceBench measurements(options, depths, device,
                              [&](const BalanceRow& row) { show(columnValues(columns(), row)); });
    const std::vector<BalanceRow> rows = measurements.measure(paths);
    const std::vector<BalanceRatio> ratios = ratiosOf(rows, depths);
    show(ratioTable(ratios));
    checkValidation(device);
    if (report)
    {
        writeReport(*report, balanceJson(device.device().report(), options, rows, ratios));
    }
}

} // namespace zvo::cli
