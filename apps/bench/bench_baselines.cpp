// SPDX-License-Identifier: MIT
#include "bench/bench_baselines.h"

#include "baseline/baseline_kernels.h"
#include "baseline/crassin_green_build.h"
#include "baseline/slides_builder.h"
#include "baseline/slides_trace.h"
#include "baseline/thesis_build.h"
#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/bench_trace.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/view.h"
#include "core/headless/compress.h"
#include "core/headless/run_job.h"
#include "zvo/error.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 720;

// What a source does, beside what zvo does for the same end.
struct Work
{
    std::string source;
    std::string name;
    std::function<double()> baseline; // runs it once and returns the device's milliseconds
    std::function<double()> zvo;
};

struct WorkRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::string source;
    std::string work;
    Spread baseline_ms;
    Spread zvo_ms;
    Spread ratio; // baseline / zvo, of runs in turns
};

struct SizeRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::string form;
    std::uint64_t voxels = 0;
    std::uint64_t nodes = 0;
    std::uint64_t bytes = 0; // of geometry
};

struct Rows
{
    std::vector<WorkRow> works;
    std::vector<SizeRow> sizes;
};

// A published figure of a source: the thesis on an RTX 3080, 720p (tables 1 and 2).
struct Published
{
    const char* scene;
    std::uint32_t resolution;
    const char* source;
    const char* work;
    double ms;
};

constexpr Published kPublished[] = {
    {"sponza", 512, "thesis", "voxelize", 401.51},
    {"sponza", 512, "thesis", "build, bottom-up", 20.80},
    {"sponza", 512, "Crassin, Green", "build, top-down", 21.18},
    {"sponza", 512, "thesis", "rays", 20.12},
};

std::optional<double> publishedMs(const WorkRow& row)
{
    const auto* const found = std::ranges::find_if(kPublished,
                                                   [&](const Published& figure)
                                                   {
                                                       return figure.scene == row.scene &&
                                                              figure.resolution == row.resolution &&
                                                              figure.source == row.source && figure.work == row.work;
                                                   });
    return found == std::end(kPublished) ? std::nullopt : std::optional(found->ms);
}

// The algorithms on one scene and grid.
class Comparison
{
public:
    Comparison(const BenchOptions& options, vk::HeadlessDevice& device, std::string scene_name, const Scene& scene,
               const GpuScene& uploaded, const Grid& grid)
        : m_options(options), m_device(device), m_scene_name(std::move(scene_name)), m_uploaded(uploaded),
          m_grid(grid), m_build{options.coverage, options.attributes, {}}
    {
        const Bounds subject = subjectOf(scene.bounds(), grid);
        m_camera = traceCamera(chooseCamera(options.camera, scene, subject, double{kWidth} / kHeight), grid, kHeight);
        m_build.capacities = buildOctree(device, uploaded, grid, m_build).capacities;
        m_octree = buildOctree(device, uploaded, grid, m_build).octree;
        addSize("zvo octree", m_octree.node_count, m_octree.geometryBytes());
    }

    Rows measure()
    {
        attempt("the thesis's algorithms", [this] { measureThesis(); });
        attempt("Crassin and Green's construction", [this] { measureCrassinGreen(); });
        attempt("the slides' algorithms", [this] { measureSlides(); });
        return std::move(m_rows);
    }

private:
    template <typename Function> void attempt(const char* what, const Function& function)
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
            talk(
                fmt::format("warning: {} at {} without {}: {}", m_scene_name, m_grid.resolution(), what, error.what()));
        }
    }

    void addSize(const char* form, std::uint64_t nodes, std::uint64_t bytes)
    {
        m_rows.sizes.push_back({m_scene_name, m_grid.resolution(), form, m_octree.voxel_count, nodes, bytes});
    }

    // Runs both once, then in turns, changing the order each time.
    void add(const Work& work)
    {
        work.baseline();
        work.zvo();
        std::vector<double> baseline_ms;
        std::vector<double> zvo_ms;
        std::vector<double> ratios;
        for (std::uint32_t turn = 0; turn < m_options.run_count; ++turn)
        {
            if (turn % 2 != 0)
            {
                zvo_ms.push_back(work.zvo());
            }
            baseline_ms.push_back(work.baseline());
            if (turn % 2 == 0)
            {
                zvo_ms.push_back(work.zvo());
            }
            ratios.push_back(zvo_ms.back() > 0 ? baseline_ms.back() / zvo_ms.back() : 0.0);
        }
        m_rows.works.push_back({m_scene_name, m_grid.resolution(), work.source, work.name, Spread::of(baseline_ms),
                                Spread::of(zvo_ms), Spread::of(ratios)});
    }

    double zvoMs(bool voxelize, bool build)
    {
        const BuildResult result = buildOctree(m_device, m_uploaded, m_grid, m_build);
        return (voxelize ? result.operationMs("voxelize") : 0.0) + (build ? result.operationMs("octree") : 0.0);
    }

    double zvoDagMs()
    {
        BuildResult result = buildOctree(m_device, m_uploaded, m_grid, m_build);
        const double ms = result.operationMs("voxelize") + result.operationMs("octree");
        return ms + compress(m_device, std::move(result.octree)).ms();
    }

    // zvo's primary rays with their beam pass. The grid of the beam is made once for an octree, before.
    [[nodiscard]] std::function<double()> zvoRays()
    {
        if (!m_tracer)
        {
            m_tracer.emplace(m_device.device());
            m_tracer->resize(kWidth, kHeight);
            m_rays.emplace(m_device, m_octree, m_camera, *m_tracer);
        }
        return [this] { return sumMs(m_rays->trace()); };
    }

    void measureThesis()
    {
        using namespace baseline;
        ThesisTriangles triangles(m_device.device(), m_uploaded);
        ThesisCells cells(m_device.device(), m_grid);
        const ThesisJob job{m_uploaded, m_grid, m_options.coverage, triangles};
        const ThesisTarget target = m_options.attributes ? ThesisTarget::Colors : ThesisTarget::Occupancy;
        add({"thesis", "voxelize", [&] { return sumMs(voxelizeThesis(m_device, job, target, cells)); },
             [&] { return zvoMs(true, false); }});
        ThesisLevels levels(m_device.device(), m_grid);
        const ThesisBuildOptions as_published{TileNumbering::Atomic};
        PointerOctree octree;
        add({"thesis", "build, bottom-up",
             [&]
             {
                 octree = {};
                 ThesisBuild built = buildThesis(m_device, cells, as_published, levels);
                 octree = std::move(built.octree);
                 return sumMs(built.passes);
             },
             [&] { return zvoMs(false, true); }});
        addSize("thesis, 12-byte nodes", octree.node_count, octree.bytes());
        PointerPicture picture(m_device.device(), kWidth, kHeight);
        add({"thesis", "rays",
             [&] { return sumMs(m_device.run([&](auto& graph) { tracePicture(graph, octree, m_camera, picture); })); },
             zvoRays()});
    }

    void measureCrassinGreen()
    {
        using namespace baseline;
        ThesisTriangles triangles(m_device.device(), m_uploaded);
        const FragmentList list = listFragments(m_device, {m_uploaded, m_grid, m_options.coverage, triangles});
        CrassinGreenBuffers buffers(m_device.device());
        add({"Crassin, Green", "build, top-down",
             [&] { return sumMs(buildTopDown(m_device, m_uploaded, m_grid, list.fragments, buffers).passes); },
             [&] { return zvoMs(false, true); }});
    }

    void measureSlides()
    {
        using namespace baseline;
        SlidesTree octree;
        SlidesTree dag;
        const auto build = [&](bool is_dag, SlidesTree& tree)
        {
            tree = {};
            SlidesResult result = runJob(
                m_device, SlidesBuilder(m_device.device(), m_uploaded, m_grid,
                                        {.coverage = m_options.coverage,
                                         .attributes = m_options.attributes,
                                         .dag = is_dag,
                                         .nodes = m_options.attributes ? SlidesNodes::WithSums : SlidesNodes::Plain}));
            tree = std::move(result.tree);
            return result.ms();
        };
        add({"slides", "voxelize and build", [&] { return build(false, octree); }, [&] { return zvoMs(true, true); }});
        add({"slides", "voxelize and build, DAG", [&] { return build(true, dag); }, [&] { return zvoDagMs(); }});
        const char* const form = m_options.attributes ? "slides octree, 68-byte nodes" : "slides octree, 36-byte nodes";
        addSize(form, octree.node_count, octree.geometryBytes());
        addSize(m_options.attributes ? "slides DAG, 68-byte nodes" : "slides DAG, 36-byte nodes", dag.node_count,
                dag.geometryBytes());
        SlidesTraceBuffers hits(m_device.device(), kWidth, kHeight);
        const auto addRays = [&](const char* name, const SlidesTraceOptions& options)
        {
            add({"slides", name,
                 [&] {
                     return sumMs(
                         m_device.run([&](auto& graph) { slidesTrace(graph, octree, m_camera, options, hits); }));
                 },
                 zvoRays()});
        };
        addRays("rays, state saved", {});
        addRays("rays, state saved, without tips", {.stop_at_far_side = false, .skip_behind = false});
        addRays("rays, children pushed", {.push_children = true});
        addRays("rays, children pushed, without tips",
                {.push_children = true, .stop_at_far_side = false, .skip_behind = false});
    }

    const BenchOptions& m_options;
    vk::HeadlessDevice& m_device;
    std::string m_scene_name;
    const GpuScene& m_uploaded;
    Grid m_grid;
    BuildOptions m_build;
    TraceCamera m_camera{};
    DeviceTree m_octree;
    std::optional<TreeTracer> m_tracer;
    std::optional<PrimaryRays> m_rays;
    Rows m_rows;
};

const Columns<WorkRow>& workColumns()
{
    using Row = WorkRow;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.resolution); }},
        {"source", 14, [](const Row& row) { return row.source; }},
        {"work", 35, [](const Row& row) { return row.work; }},
        {"published ms", 12,
         [](const Row& row)
         {
             const std::optional<double> ms = publishedMs(row);
             return ms ? fmt::format("{:.2f}", *ms) : "-";
         }},
        {"baseline ms", 11, [](const Row& row) { return fmt::format("{:.2f}", row.baseline_ms.median); }},
        {"zvo ms", 9, [](const Row& row) { return fmt::format("{:.2f}", row.zvo_ms.median); }},
        {"baseline / zvo", 14, [](const Row& row) { return fmt::format("{:.2f}", row.ratio.median); }},
    };
    return all;
}

const Columns<SizeRow>& sizeColumns()
{
    using Row = SizeRow;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.resolution); }},
        {"form", 28, [](const Row& row) { return row.form; }},
        {"voxels", 9, [](const Row& row) { return fmt::format("{}", row.voxels); }},
        {"nodes", 9, [](const Row& row) { return fmt::format("{}", row.nodes); }},
        {"bytes a voxel", 13,
         [](const Row& row)
         {
             const auto voxels = static_cast<double>(std::max<std::uint64_t>(row.voxels, 1));
             return fmt::format("{:.2f}", static_cast<double>(row.bytes) / voxels);
         }},
    };
    return all;
}

std::string tables(const vk::DeviceReport& device, const BenchOptions& options, const Rows& rows)
{
    std::string text = fmt::format(
        "zvo {} on {} ({}, {}). {} coverage, {}; GPU milliseconds, medians of {} runs in turns; rays of {}x{} pixels, "
        "zvo's with their beam pass. Published: the thesis on an RTX 3080, 512^3, 720p.\n\n{}",
        ZVO_VERSION_TEXT, device.name, device.type, device.driver, coverageName(options.coverage),
        options.attributes ? "with attributes" : "geometry alone", options.run_count, kWidth, kHeight,
        columnNames(workColumns()));
    for (const WorkRow& row : rows.works)
    {
        text += columnValues(workColumns(), row);
    }
    text += fmt::format("\n{}", columnNames(sizeColumns()));
    for (const SizeRow& row : rows.sizes)
    {
        text += columnValues(sizeColumns(), row);
    }
    return text;
}

Json reportJson(const vk::DeviceReport& device, const BenchOptions& options, const Rows& rows)
{
    Json json = headJson("zvo.bench_baselines/1", device);
    json["coverage"] = coverageName(options.coverage);
    json["attributes"] = options.attributes ? "full" : "none";
    json["runs"] = options.run_count;
    json["size"] = {kWidth, kHeight};
    json["rows"] = Json::array();
    for (const WorkRow& row : rows.works)
    {
        const std::optional<double> published = publishedMs(row);
        json["rows"].push_back({{"scene", row.scene},
                                {"resolution", row.resolution},
                                {"source", row.source},
                                {"work", row.work},
                                {"published_ms", published ? Json(*published) : Json()},
                                {"baseline_ms", spreadJson(row.baseline_ms)},
                                {"zvo_ms", spreadJson(row.zvo_ms)},
                                {"ratio", spreadJson(row.ratio)}});
    }
    json["sizes"] = Json::array();
    for (const SizeRow& row : rows.sizes)
    {
        json["sizes"].push_back({{"scene", row.scene},
                                 {"resolution", row.resolution},
                                 {"form", row.form},
                                 {"voxels", row.voxels},
                                 {"nodes", row.nodes},
                                 {"bytes", row.bytes}});
    }
    return json;
}

} // namespace

void benchBaselines(const BenchOptions& options)
{
    const std::vector<fs::path> paths = benchScenes(options);
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), baseline::allKernels());
    const bool is_cpu = device.device().report().type == "cpu";
    const std::vector<std::uint32_t> depths =
        options.depths.value_or(is_cpu ? std::vector{7U, 8U} : std::vector{8U, 9U, 10U});
    Rows rows;
    Progress progress(paths.size() * depths.size());
    for (const fs::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        const GpuScene uploaded = uploadScene(device, scene, options.attributes);
        for (const std::uint32_t depth : depths)
        {
            progress.begin(fmt::format("{} at {}", path.stem().string(), 1U << depth));
            Rows more =
                Comparison(options, device, path.stem().string(), scene, uploaded, Grid::around(scene.bounds(), depth))
                    .measure();
            std::ranges::move(more.works, std::back_inserter(rows.works));
            std::ranges::move(more.sizes, std::back_inserter(rows.sizes));
        }
    }
    clearProgressBar();
    if (options.output.json != "-")
    {
        Output table("-", true);
        table.write(tables(device.device().report(), options, rows));
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, reportJson(device.device().report(), options, rows));
    }
}

} // namespace zvo::cli
