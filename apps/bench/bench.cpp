// SPDX-License-Identifier: MIT
#include "bench/bench.h"

#include "bench/bench_balance.h"
#include "bench/bench_baselines.h"
#include "bench/bench_denoise.h"
#include "bench/bench_dynamic.h"
#include "bench/bench_edit.h"
#include "bench/bench_kept.h"
#include "bench/bench_path.h"
#include "bench/bench_report.h"
#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/bench_table.h"
#include "bench/bench_trace.h"
#include "bench/bench_tune.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/view.h"
#include "core/base/kernels.h"
#include "core/headless/compress.h"
#include "core/headless/pipeline.h"
#include "core/headless/tree_download.h"
#include "core/trace/tree_tracer.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "zvo/error.h"

#ifdef ZVO_EMBREE
#include "bench/bench_embree.h"
#endif

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <variant>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr std::uint32_t kWidth = 1920;
constexpr std::uint32_t kHeight = 1080;

// Marks passes as those of compression and the DAG's pictures, apart from those of the octree.
std::vector<vk::PassTime> ofDag(std::vector<vk::PassTime> passes)
{
    for (vk::PassTime& pass : passes)
    {
        pass.name += " (DAG)";
    }
    return passes;
}

class Bench
{
public:
    Bench(const BenchOptions& options, vk::HeadlessDevice& device) : m_options(options), m_device(device) {}

    BenchRow measure(const std::string& name, const Scene& scene, const GpuScene& gpu_scene, std::uint32_t depth)
    {
        m_device.device().memory().resetPeak();
        BenchRow row;
        row.scene = name;
        row.resolution = 1U << depth;
        row.coverage = m_options.coverage;
        row.attributes = m_options.attributes;
        row.triangles = scene.triangleCount();
        const Grid grid = Grid::around(scene.bounds(), depth);
        BuildRuns runs = measureBuild(m_device, gpu_scene, grid, {m_options.coverage, m_options.attributes, {}},
                                      m_options.run_count);
        row.voxelize_ms = runs.voxelize_ms;
        row.build_ms = runs.build_ms;
        row.passes = std::move(runs.passes);
        const DeviceTree& octree = runs.last.octree;
        const Bounds subject = subjectOf(scene.bounds(), grid);
        const ViewCamera view = chooseCamera(m_options.camera, scene, subject, double{kWidth} / kHeight);
        const TraceCamera camera = traceCamera(view, grid, kHeight);
        row.voxels = octree.voxel_count;
        row.nodes = octree.node_count;
        row.geometry_bytes = octree.geometryBytes();
        row.attribute_bytes = octree.attributeBytes();
        measureTrees(octree, camera, row);
#ifdef ZVO_EMBREE
        measureEmbree(scene, octree, camera, row);
#endif
        return row;
    }

private:
    // Measures primary rays through the octree, compression, and rays through both.
    void measureTrees(const DeviceTree& octree, const TraceCamera& camera, BenchRow& row)
    {
        TreeTracer tracer(m_device.device());
        tracer.resize(kWidth, kHeight);
        PrimaryRays octree_rays(m_device, octree, camera, tracer);
        row.node_paths_ms = octree_rays.nodePathsMs();
        row.rays = primaryRayCount(tracer.buffers());
        row.hits = countHits(m_device, tracer.buffers());
        row.peak_device_bytes = m_device.device().memory().peakBytes();
        const std::uint32_t turn_count = kTraceTurns * m_options.run_count;
        TraceRuns runs;
        try
        {
            Compression compression = measureCompress(octree);
            PrimaryRays dag_rays(m_device, compression.dag, camera, tracer);
            runs = traceInTurns(octree_rays, dag_rays, turn_count);
            row.dag = compression.numbers;
            row.dag->trace_ms = runs.dag_ms;
            row.dag->trace_ratio = runs.ratio;
            addPasses(row.passes, std::move(compression.passes), 1);
        }
        catch (const Error& error)
        {
            if (error.code() != ErrorCode::Memory)
            {
                throw;
            }
            talk(fmt::format("warning: no DAG of {} at {}: {}", row.scene, row.resolution, error.what()));
            runs = traceAlone(octree_rays, turn_count);
        }
        row.trace_ms = runs.octree_ms;
        addPasses(row.passes, runs.octree_passes, 1);
        addPasses(row.passes, ofDag(runs.dag_passes), 1);
    }

    struct Compression
    {
        DeviceTree dag;
        DagNumbers numbers;               // all but those of pictures
        std::vector<vk::PassTime> passes; // mean of the runs, summed by name
    };

    // Measures compression after a warm-up. Each run uses up a copy of the octree. Throws Error{Memory} if memory does
    // not suffice for both at once.
    Compression measureCompress(const DeviceTree& octree)
    {
        const TreeData copy = downloadTree(m_device, octree);
        const auto run = [&] { return compress(m_device, uploadTree(m_device, copy)); };
        CompressResult compressed = run();
        Compression compression;
        std::vector<double> compress_ms;
        for (std::uint32_t i = 0; i < m_options.run_count; ++i)
        {
            compressed = {}; // frees its memory before the next one is made
            compressed = run();
            compress_ms.push_back(compressed.ms());
            addPasses(compression.passes, ofDag(compressed.passes), m_options.run_count);
        }
        compression.numbers.compress_ms = Spread::of(compress_ms);
        compression.numbers.nodes = compressed.dag.node_count;
        compression.numbers.geometry_bytes = compressed.dag.geometryBytes();
        compression.numbers.rank_bytes = compressed.dag.lists.rankBytes();
        compression.dag = std::move(compressed.dag);
        return compression;
    }

#ifdef ZVO_EMBREE
    void measureEmbree(const Scene& scene, const DeviceTree& octree, const TraceCamera& camera, BenchRow& row)
    {
        const std::vector<PrimaryRay> rays = primaryRays(camera, kWidth, kHeight);
        const EmbreeResult voxels = zvo::cli::measureEmbree(
            EmbreeScene::ofVoxels(octree.grid, voxelCodes(m_device, octree)), rays, m_options.run_count);
        const EmbreeResult triangles =
            zvo::cli::measureEmbree(EmbreeScene::ofTriangles(octree.grid, scene), rays, m_options.run_count);
        row.embree_user_mrays_per_s = voxels.mrays_per_s;
        row.embree_user_single_mrays_per_s = voxels.single_mrays_per_s;
        row.embree_user_hits = voxels.hit_count;
        row.embree_triangle_mrays_per_s = triangles.mrays_per_s;
        row.embree_triangle_single_mrays_per_s = triangles.single_mrays_per_s;
    }
#endif

    const BenchOptions& m_options;
    vk::HeadlessDevice& m_device;
};

} // namespace

void bench(const BenchOptions& options)
{
    if (!options.reports.empty())
    {
        benchReport(options);
        return;
    }
    if (options.dynamic)
    {
        benchDynamic(options);
        return;
    }
    if (options.path)
    {
        benchPath(options);
        return;
    }
    if (options.denoise)
    {
        benchDenoise(options);
        return;
    }
    if (options.kept)
    {
        benchKept(options);
        return;
    }
    if (options.tune)
    {
        benchTune(options);
        return;
    }
    if (options.edit)
    {
        benchEdit(options);
        return;
    }
    if (options.balance)
    {
        benchBalance(options);
        return;
    }
    if (options.baselines)
    {
        benchBaselines(options);
        return;
    }
    const std::vector<fs::path> paths = benchScenes(options);
    const std::vector<std::uint32_t> depths = options.depths.value_or(std::vector{8U, 9U, 10U});
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    Output table("-", true);
    const bool show_table = options.output.json != "-";
    const BenchHeader header = {device.device().report(), kWidth, kHeight, options.run_count};
    if (show_table)
    {
        table.write(tableHead(header));
    }
    Bench measurements(options, device);
    std::vector<BenchRow> rows;
    Progress progress(paths.size() * depths.size());
    for (const fs::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        const GpuScene gpu_scene = uploadScene(device, scene, options.attributes);
        for (const std::uint32_t depth : depths)
        {
            progress.begin(fmt::format("{} at {}", path.stem().string(), 1U << depth));
            rows.push_back(measurements.measure(path.stem().string(), scene, gpu_scene, depth));
            if (show_table)
            {
                clearProgressBar();
                table.write(tableLine(rows.back()));
            }
        }
    }
    if (show_table && options.passes)
    {
        for (const BenchRow& row : rows)
        {
            table.write(passTable(row.scene, row.resolution, row.passes));
        }
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, benchJson(header, rows));
    }
}

} // namespace zvo::cli
