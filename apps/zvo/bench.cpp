// SPDX-License-Identifier: MIT
#include "bench.h"

#include "bench_balance.h"
#include "bench_dynamic.h"
#include "bench_runs.h"
#include "bench_scenes.h"
#include "bench_table.h"
#include "core/gpu_scene.h"
#include "core/kernels.h"
#include "core/pipeline.h"
#include "core/trace.h"
#include "output.h"
#include "progress.h"
#include "session.h"
#include "view.h"
#include "zvo/error.h"

#ifdef ZVO_EMBREE
#include "bench_embree.h"
#endif

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr std::uint32_t kWidth = 1920;
constexpr std::uint32_t kHeight = 1080;
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
        const Octree& octree = runs.last.octree;
        const Bounds subject = subjectOf(scene.bounds(), grid);
        const ViewCamera view = chooseCamera(m_options.camera, scene, subject, double{kWidth} / kHeight);
        const TraceCamera camera = traceCamera(view, grid, kHeight);
        measureTrace(octree, camera, row);
        row.voxels = octree.voxel_count;
        row.nodes = octree.node_count;
        row.geometry_bytes = octree.geometryBytes();
        row.attribute_bytes = octree.attributeBytes();
        row.peak_device_bytes = m_device.device().memory().peakBytes();
#ifdef ZVO_EMBREE
        measureEmbree(scene, octree, camera, row);
#endif
        return row;
    }

private:
    // Primary rays, after a warm-up.
    void measureTrace(const Octree& octree, const TraceCamera& camera, BenchRow& row)
    {
        BeamGrid beam(m_device.device());
        TraceBuffers buffers(m_device.device(), kWidth, kHeight);
        const std::vector<vk::PassTime> beam_passes =
            m_device.run([&](vk::FrameGraph& graph) { buildBeam(graph, octree, beam); });
        const auto tracePicture = [&]
        {
            return m_device.run([&](vk::FrameGraph& graph)
                                { tracePrimary(graph, octree, beam, camera, TraceOptions{}, buffers); });
        };
        tracePicture();
        std::vector<double> trace_ms;
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            const std::vector<vk::PassTime> passes = tracePicture();
            trace_ms.push_back(sumMs(passes));
            addPasses(row.passes, passes, m_options.run_count);
        }
        row.beam_grid_ms = sumMs(beam_passes);
        row.trace_ms = Spread::of(trace_ms);
        row.rays = primaryRayCount(buffers);
        row.hits = countHits(buffers);
    }

    // Pixels whose ray hit something.
    std::uint64_t countHits(const TraceBuffers& buffers)
    {
        const std::vector<gpu::Hit> hits = m_device.download(buffers.hits);
        const std::vector<float> starts = m_device.download(buffers.starts);
        const std::uint32_t tiles_x = (kWidth + gpu::kTileEdge - 1) / gpu::kTileEdge;
        std::uint64_t count = 0;
        for (std::size_t pixel = 0; pixel < hits.size(); ++pixel)
        {
            const std::size_t tile = pixel / kWidth / gpu::kTileEdge * tiles_x + pixel % kWidth / gpu::kTileEdge;
            count += starts[tile] != gpu::kTileDead && hits[pixel].index != gpu::kHitMiss ? 1 : 0;
        }
        return count;
    }

#ifdef ZVO_EMBREE
    void measureEmbree(const Scene& scene, const Octree& octree, const TraceCamera& camera, BenchRow& row)
    {
        const std::vector<PrimaryRay> rays = primaryRays(camera, kWidth, kHeight);
        const EmbreeResult voxels =
            traceVoxelsByEmbree(octree.grid, voxelCodes(m_device, octree), rays, m_options.run_count);
        const EmbreeResult triangles = traceTrianglesByEmbree(octree.grid, scene, rays, m_options.run_count);
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
    if (options.dynamic)
    {
        benchDynamic(options);
        return;
    }
    if (options.balance)
    {
        benchBalance(options);
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
            progress.step(fmt::format("{} at {}", path.stem().string(), 1U << depth));
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
        report->write(jsonText(benchJson(header, rows)));
        report->finish();
    }
}

} // namespace zvo::cli
