// SPDX-License-Identifier: MIT
#include "bench/bench_build.h"

#include "bench/bench_rows.h"
#include "bench/bench_runs.h"
#include "bench/bench_table.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "runtime/trees.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

std::string percentText(const std::optional<double>& part)
{
    return part ? fmt::format("{:.1f} %", 100 * *part) : "-";
}

Columns<BenchRow> buildColumns()
{
    Columns<BenchRow> columns = octreeColumns();
    const Columns<BenchRow> more = {
        {"geometry B/voxel", 16,
         [](const BenchRow& row) { return fmt::format("{:.3f}", row.perVoxel(row.geometry_bytes)); }},
        {"attributes B/voxel", 18,
         [](const BenchRow& row) { return fmt::format("{:.3f}", row.perVoxel(row.attribute_bytes)); }},
        {"voxelize ms", 23, [](const BenchRow& row) { return cellText(row.voxelize_ms); }},
        {"build ms", 23, [](const BenchRow& row) { return cellText(row.build_ms); }},
        {"Mvoxels/s", 9, [](const BenchRow& row) { return cellText(row.mvoxelsPerSecond(), 1); }},
        {"compress ms", 23, [](const BenchRow& row) { return cellText(row.compress_ms); }},
        {"of both", 7, [](const BenchRow& row) { return percentText(row.compressRatio()); }},
        {"DAG nodes", 9, [](const BenchRow& row) { return row.dag ? fmt::format("{}", row.dag->nodes) : "-"; }},
        {"DAG B/voxel", 11,
         [](const BenchRow& row)
         { return row.dag ? fmt::format("{:.3f}", row.perVoxel(row.dag->geometry_bytes)) : "-"; }},
        {"of octree", 9, [](const BenchRow& row) { return percentText(row.dagGeometryRatio()); }},
        peakColumn(),
    };
    columns.insert(columns.end(), more.begin(), more.end());
    return columns;
}

// Measures compression after a warm-up. Each run uses up a copy of the octree.
void measureCompress(vk::HeadlessDevice& device, const DeviceTree& octree, std::uint32_t run_count, BenchRow& row)
{
    const TreeData copy = downloadTree(device, octree);
    const auto run = [&] { return compress(device, uploadTree(device, copy)); };
    CompressResult compressed = run();
    std::vector<double> compress_ms;
    std::vector<vk::PassTime> passes;
    for (std::uint32_t i = 0; i < run_count; ++i)
    {
        compressed = {}; // frees its memory before the next one is made
        compressed = run();
        compress_ms.push_back(compressed.ms());
        addPasses(passes, ofDag(compressed.passes), run_count);
    }
    row.compress_ms = Spread::of(compress_ms);
    row.dag = DagSize::of(compressed.dag);
    addPasses(row.passes, std::move(passes), 1);
}

} // namespace

void benchBuild(const BenchBuildOptions& options)
{
    const RowTable table = {fmt::format("GPU milliseconds: median (min-max) of {}. Compress: of voxelize and build.",
                                        warmRuns(options.run_count)),
                            buildColumns(), std::nullopt, std::nullopt};
    const auto measure = [&](vk::HeadlessDevice& device, const BenchSubject& subject, BenchRow& row)
    {
        BuildRuns runs = measureBuild(
            device, subject.uploaded, subject.grid,
            {.coverage = options.coverage, .attributes = options.attributes, .fill = options.fill}, options.run_count);
        row.peak_device_bytes = device.device().memory().peakBytes();
        row.voxelize_ms = runs.voxelize_ms;
        row.build_ms = runs.build_ms;
        row.passes = std::move(runs.passes);
        row.setSizes(runs.last.octree);
        withDag(row, [&] { measureCompress(device, runs.last.octree, options.run_count, row); });
    };
    measureRows(options, table, measure);
}

} // namespace zvo::cli
