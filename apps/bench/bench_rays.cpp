// SPDX-License-Identifier: MIT
#include "bench/bench_rays.h"

#include "bench/bench_ray_kinds.h"
#include "bench/bench_rows.h"
#include "bench/bench_runs.h"
#include "bench/bench_table.h"
#include "bench/bench_trace.h"
#include "common/view.h"
#include "core/trace/tree_tracer.h"
#include "core/tree/device_tree.h"
#include "runtime/trees.h"

#ifdef ZVO_EMBREE
#include "bench/bench_embree.h"
#include "bench/primary_rays.h"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kRaysWidth = 1920;
constexpr std::uint32_t kRaysHeight = 1080;

std::string hitPercent(const BenchRow& row)
{
    const double hits = 100.0 * static_cast<double>(row.hits.value_or(0));
    return fmt::format("{:.0f}", hits / static_cast<double>(std::max<std::uint64_t>(row.rays.value_or(0), 1)));
}

#ifdef ZVO_EMBREE
constexpr const char* kOfEmbree =
    " Ratio: zvo / Embree, by packets of 8 or 16 rays, whichever is faster, and by single "
    "rays, on all processors.";

std::string ratioTo(const BenchRow& row, const std::optional<double>& theirs)
{
    const std::optional<double> ours = row.mraysPerSecond();
    return ours && theirs && *theirs > 0 ? cellText(*ours / *theirs, 2) : "-";
}

const Columns<BenchRow>& embreeColumns()
{
    using Row = BenchRow;
    static const Columns<Row> all = {
        {"Embree voxels", 13, [](const Row& row) { return cellText(row.embree_user_mrays_per_s, 1); }},
        {"ratio", 5, [](const Row& row) { return ratioTo(row, row.embree_user_mrays_per_s); }},
        {"single", 6, [](const Row& row) { return cellText(row.embree_user_single_mrays_per_s, 1); }},
        {"ratio", 5, [](const Row& row) { return ratioTo(row, row.embree_user_single_mrays_per_s); }},
        {"Embree triangles", 16, [](const Row& row) { return cellText(row.embree_triangle_mrays_per_s, 1); }},
        {"ratio", 5, [](const Row& row) { return ratioTo(row, row.embree_triangle_mrays_per_s); }},
        {"single", 6, [](const Row& row) { return cellText(row.embree_triangle_single_mrays_per_s, 1); }},
    };
    return all;
}

void traceByEmbree(vk::HeadlessDevice& device, const BenchSubject& subject, const DeviceTree& octree,
                   const TraceCamera& camera, std::uint32_t run_count, BenchRow& row)
{
    const std::vector<PrimaryRay> rays = primaryRays(camera, kRaysWidth, kRaysHeight);
    const EmbreeResult voxels =
        measureEmbree(EmbreeScene::ofVoxels(octree.grid, voxelCodes(device, octree)), rays, run_count);
    const EmbreeResult triangles = measureEmbree(EmbreeScene::ofTriangles(octree.grid, subject.scene), rays, run_count);
    row.embree_user_mrays_per_s = voxels.mrays_per_s;
    row.embree_user_single_mrays_per_s = voxels.single_mrays_per_s;
    row.embree_user_hits = voxels.hit_count;
    row.embree_triangle_mrays_per_s = triangles.mrays_per_s;
    row.embree_triangle_single_mrays_per_s = triangles.single_mrays_per_s;
}
#else
constexpr const char* kOfEmbree = "";

Columns<BenchRow> embreeColumns()
{
    return {};
}

void traceByEmbree(vk::HeadlessDevice&, const BenchSubject&, const DeviceTree&, const TraceCamera&, std::uint32_t,
                   BenchRow&)
{
}
#endif

Columns<BenchRow> raysColumns()
{
    Columns<BenchRow> columns = octreeColumns();
    const auto add = [&](const Columns<BenchRow>& more) { columns.insert(columns.end(), more.begin(), more.end()); };
    add({{"trace ms", 23, [](const BenchRow& row) { return cellText(row.trace_ms); }},
         {"trace DAG ms", 23, [](const BenchRow& row) { return cellText(row.trace_dag_ms); }},
         {"ratio", 16, [](const BenchRow& row) { return cellText(row.trace_dag_ratio); }},
         {"Mrays/s", 7, [](const BenchRow& row) { return cellText(row.mraysPerSecond(), 1); }},
         {"hits %", 6, hitPercent}});
    add(embreeColumns());
    columns.push_back(peakColumn());
    return columns;
}

// Traces octree and DAG in turns, or the octree alone where memory does not suffice for both.
void tracePictures(vk::HeadlessDevice& device, const DeviceTree& octree, const TraceCamera& camera,
                   const BenchRaysOptions& options, BenchRow& row)
{
    const std::uint32_t turn_count = kTraceTurns * options.run_count;
    TreeTracer tracer(device.device());
    tracer.resize(kRaysWidth, kRaysHeight);
    PrimaryRays octree_rays(device, octree, camera, tracer);
    warmUp(device, [&] { octree_rays.trace(); });
    row.node_paths_ms = octree_rays.nodePathsMs();
    row.rays = primaryRayCount(tracer.buffers());
    row.hits = countHits(device, tracer.buffers());
    row.peak_device_bytes = device.device().memory().peakBytes();
    TraceRuns runs;
    const auto measureKinds = [&](const DeviceTree* dag)
    {
        if (!options.kinds.empty())
        {
            row.kinds = measureRayKinds(device, octree, dag, camera, {kRaysWidth, kRaysHeight}, options);
        }
    };
    const auto in_turns = [&]
    {
        const DeviceTree dag = compress(device, uploadTree(device, downloadTree(device, octree))).dag;
        PrimaryRays dag_rays(device, dag, camera, tracer);
        runs = traceInTurns(octree_rays, dag_rays, turn_count);
        row.dag = DagSize::of(dag);
        row.trace_dag_ms = runs.dag_ms;
        row.trace_dag_ratio = runs.ratio;
        measureKinds(&dag);
    };
    if (!withDag(row, in_turns))
    {
        runs = traceAlone(octree_rays, turn_count);
        measureKinds(nullptr);
    }
    row.trace_ms = runs.octree_ms;
    addPasses(row.passes, runs.octree_passes, 1);
    addPasses(row.passes, ofDag(runs.dag_passes), 1);
}

} // namespace

void benchRays(const BenchRaysOptions& options)
{
    const RowTable table = {
        fmt::format("Primary rays, {}x{}, million a second, and GPU milliseconds: median (min-max) of {}, {} times as "
                    "many pictures. Octree and DAG in turns, ratio of neighbours.{}",
                    kRaysWidth, kRaysHeight, warmRuns(options.run_count), kTraceTurns, kOfEmbree),
        raysColumns(), kRaysWidth, kRaysHeight};
    const auto measure = [&](vk::HeadlessDevice& device, const BenchSubject& subject, BenchRow& row)
    {
        const DeviceTree octree =
            buildOctree(device, subject.uploaded, subject.grid, {options.coverage, options.attributes, {}}).octree;
        row.setSizes(octree);
        const Bounds bounds = subjectOf(subject.scene.bounds(), subject.grid);
        const ViewCamera view = chooseCamera(options.camera, subject.scene, bounds, double{kRaysWidth} / kRaysHeight);
        const TraceCamera camera = traceCamera(view, subject.grid, kRaysHeight);
        tracePictures(device, octree, camera, options, row);
        traceByEmbree(device, subject, octree, camera, options.run_count, row);
    };
    measureRows(options, table, measure);
}

} // namespace zvo::cli
