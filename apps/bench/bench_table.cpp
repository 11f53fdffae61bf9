// SPDX-License-Identifier: MIT
#include "bench/bench_table.h"

#include "bench/table.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>

namespace zvo::cli
{

namespace
{

constexpr double kMiB = 1 << 20;

std::string rate(const std::optional<double>& value)
{
    return value ? fmt::format("{:.1f}", *value) : "-";
}

std::string ratio(double ours, const std::optional<double>& theirs)
{
    return theirs && *theirs > 0 ? fmt::format("{:.2f}", ours / *theirs) : "-";
}

std::string percent(double part)
{
    return fmt::format("{:.1f} %", 100 * part);
}

// The text for the DAG, or a dash if there is none.
template <typename Text> std::string orDash(const std::optional<DagNumbers>& dag, const Text& text)
{
    return dag ? text(*dag) : "-";
}

const Columns<BenchRow>& columns()
{
    static const Columns<BenchRow> all = {
        {"scene", 12, [](const BenchRow& row) { return row.scene; }},
        {"resolution", 10, [](const BenchRow& row) { return fmt::format("{}", row.resolution); }},
        {"coverage", 8, [](const BenchRow& row) { return std::string(coverageName(row.coverage)); }},
        {"triangles", 9, [](const BenchRow& row) { return fmt::format("{}", row.triangles); }},
        {"voxels", 9, [](const BenchRow& row) { return fmt::format("{}", row.voxels); }},
        {"nodes", 9, [](const BenchRow& row) { return fmt::format("{}", row.nodes); }},
        {"geometry B/voxel", 16,
         [](const BenchRow& row) { return fmt::format("{:.3f}", row.perVoxel(row.geometry_bytes)); }},
        {"attributes B/voxel", 18,
         [](const BenchRow& row) { return fmt::format("{:.3f}", row.perVoxel(row.attribute_bytes)); }},
        {"voxelize ms", 23, [](const BenchRow& row) { return spreadText(row.voxelize_ms); }},
        {"build ms", 23, [](const BenchRow& row) { return spreadText(row.build_ms); }},
        {"compress ms", 23,
         [](const BenchRow& row)
         { return orDash(row.dag, [](const DagNumbers& dag) { return spreadText(dag.compress_ms); }); }},
        {"of both", 7,
         [](const BenchRow& row)
         { return orDash(row.dag, [&](const DagNumbers& dag) { return percent(row.compressRatio(dag)); }); }},
        {"DAG nodes", 9,
         [](const BenchRow& row)
         { return orDash(row.dag, [](const DagNumbers& dag) { return fmt::format("{}", dag.nodes); }); }},
        {"DAG B/voxel", 11,
         [](const BenchRow& row)
         {
             return orDash(row.dag, [&](const DagNumbers& dag)
                           { return fmt::format("{:.3f}", row.perVoxel(dag.geometry_bytes)); });
         }},
        {"of octree", 9,
         [](const BenchRow& row)
         { return orDash(row.dag, [&](const DagNumbers& dag) { return percent(row.dagGeometryRatio(dag)); }); }},
        {"trace ms", 23, [](const BenchRow& row) { return spreadText(row.trace_ms); }},
        {"trace DAG ms", 23,
         [](const BenchRow& row)
         { return orDash(row.dag, [](const DagNumbers& dag) { return spreadText(dag.trace_ms); }); }},
        {"ratio", 16,
         [](const BenchRow& row)
         { return orDash(row.dag, [](const DagNumbers& dag) { return spreadText(dag.trace_ratio); }); }},
        {"Mvoxels/s", 9, [](const BenchRow& row) { return rate(row.mvoxelsPerSecond()); }},
        {"Mrays/s", 7, [](const BenchRow& row) { return rate(row.mraysPerSecond()); }},
        {"hits %", 6,
         [](const BenchRow& row)
         {
             const double hits = 100.0 * static_cast<double>(row.hits);
             return fmt::format("{:.0f}", hits / static_cast<double>(std::max<std::uint64_t>(row.rays, 1)));
         }},
        {"Embree voxels", 13, [](const BenchRow& row) { return rate(row.embree_user_mrays_per_s); }},
        {"ratio", 5, [](const BenchRow& row) { return ratio(row.mraysPerSecond(), row.embree_user_mrays_per_s); }},
        {"single", 6, [](const BenchRow& row) { return rate(row.embree_user_single_mrays_per_s); }},
        {"ratio", 5,
         [](const BenchRow& row) { return ratio(row.mraysPerSecond(), row.embree_user_single_mrays_per_s); }},
        {"Embree triangles", 16, [](const BenchRow& row) { return rate(row.embree_triangle_mrays_per_s); }},
        {"ratio", 5, [](const BenchRow& row) { return ratio(row.mraysPerSecond(), row.embree_triangle_mrays_per_s); }},
        {"single", 6, [](const BenchRow& row) { return rate(row.embree_triangle_single_mrays_per_s); }},
        {"peak MiB", 8,
         [](const BenchRow& row) { return fmt::format("{:.0f}", static_cast<double>(row.peak_device_bytes) / kMiB); }},
    };
    return all;
}

template <typename T> Json orNull(const std::optional<T>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

// The value for the DAG, or null if there is none.
template <typename Value> Json dagJson(const std::optional<DagNumbers>& dag, const Value& value)
{
    return dag ? Json(value(*dag)) : Json(nullptr);
}

Json rowJson(const BenchRow& row)
{
    Json json;
    json["scene"] = row.scene;
    json["resolution"] = row.resolution;
    json["coverage"] = coverageName(row.coverage);
    json["attributes"] = row.attributes ? "full" : "none";
    json["triangles"] = row.triangles;
    json["voxels"] = row.voxels;
    json["nodes"] = row.nodes;
    json["geometry_bytes"] = row.geometry_bytes;
    json["geometry_bytes_per_voxel"] = row.perVoxel(row.geometry_bytes);
    json["attribute_bytes_per_voxel"] = row.perVoxel(row.attribute_bytes);
    json["voxelize_ms"] = spreadJson(row.voxelize_ms);
    json["build_ms"] = spreadJson(row.build_ms);
    const auto ofDag = [&](const auto& value) { return dagJson(row.dag, value); };
    json["compress_ms"] = ofDag([](const DagNumbers& dag) { return spreadJson(dag.compress_ms); });
    json["compress_ratio"] = ofDag([&](const DagNumbers& dag) { return row.compressRatio(dag); });
    json["dag_nodes"] = ofDag([](const DagNumbers& dag) { return dag.nodes; });
    json["dag_geometry_bytes"] = ofDag([](const DagNumbers& dag) { return dag.geometry_bytes; });
    json["dag_geometry_bytes_per_voxel"] =
        ofDag([&](const DagNumbers& dag) { return row.perVoxel(dag.geometry_bytes); });
    json["dag_geometry_ratio"] = ofDag([&](const DagNumbers& dag) { return row.dagGeometryRatio(dag); });
    json["dag_rank_bytes"] = ofDag([](const DagNumbers& dag) { return dag.rank_bytes; });
    json["trace_ms"] = spreadJson(row.trace_ms);
    json["trace_dag_ms"] = ofDag([](const DagNumbers& dag) { return spreadJson(dag.trace_ms); });
    json["trace_dag_ratio"] = ofDag([](const DagNumbers& dag) { return spreadJson(dag.trace_ratio); });
    json["mvoxels_per_s"] = row.mvoxelsPerSecond();
    json["mrays_per_s"] = row.mraysPerSecond();
    json["embree_user_mrays_per_s"] = orNull(row.embree_user_mrays_per_s);
    json["embree_triangle_mrays_per_s"] = orNull(row.embree_triangle_mrays_per_s);
    json["peak_device_bytes"] = row.peak_device_bytes;
    json["node_paths_ms"] = row.node_paths_ms;
    json["rays"] = row.rays;
    json["hits"] = row.hits;
    json["embree_user_hits"] = orNull(row.embree_user_hits);
    json["embree_user_single_mrays_per_s"] = orNull(row.embree_user_single_mrays_per_s);
    json["embree_triangle_single_mrays_per_s"] = orNull(row.embree_triangle_single_mrays_per_s);
    json["passes"] = passesJson(row.passes);
    return json;
}

} // namespace

Spread Spread::of(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const double median = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
    return {median, values.front(), values.back()};
}

std::string spreadText(const Spread& spread)
{
    return fmt::format("{:.2f} ({:.2f}-{:.2f})", spread.median, spread.min, spread.max);
}

Json spreadJson(const Spread& spread)
{
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

double BenchRow::perVoxel(std::uint64_t bytes) const
{
    return voxels == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(voxels);
}

double BenchRow::mvoxelsPerSecond() const
{
    const double ms = voxelize_ms.median + build_ms.median;
    return ms > 0 ? static_cast<double>(voxels) / ms / 1e3 : 0.0;
}

double BenchRow::mraysPerSecond() const
{
    return trace_ms.median > 0 ? static_cast<double>(rays) / trace_ms.median / 1e3 : 0.0;
}

double BenchRow::dagGeometryRatio(const DagNumbers& numbers) const
{
    return geometry_bytes == 0 ? 0.0
                               : static_cast<double>(numbers.geometry_bytes) / static_cast<double>(geometry_bytes);
}

double BenchRow::compressRatio(const DagNumbers& numbers) const
{
    const double ms = voxelize_ms.median + build_ms.median;
    return ms > 0 ? numbers.compress_ms.median / ms : 0.0;
}

std::string tableHead(const BenchHeader& header)
{
    return fmt::format("zvo {} on {} ({}, {}). GPU milliseconds: median (min-max) of {} warm {}, {} times as "
                       "many pictures. Compress: of voxelize and build. Trace: octree and DAG in turns, ratio of "
                       "neighbours. Rays: primary, {}x{}, million a second; ratio: zvo / Embree "
                       "(packets of 8 or 16 rays, whichever is faster, and single rays; on all processors).\n\n",
                       ZVO_VERSION_TEXT, header.device.name, header.device.type, header.device.driver, header.run_count,
                       header.run_count == 1 ? "run" : "runs", kTraceTurns, header.width, header.height) +
           columnNames(columns());
}

std::string tableLine(const BenchRow& row)
{
    return columnValues(columns(), row);
}

std::string passTable(const std::string& scene, std::uint32_t resolution, const std::vector<vk::PassTime>& passes)
{
    double sum = 0;
    std::size_t width = 4;
    for (const vk::PassTime& pass : passes)
    {
        sum += pass.ms;
        width = std::max(width, pass.name.size());
    }
    std::string table = fmt::format("\n{}, {}:\n\n| {:<{}} |        ms | share |\n|{:-<{}}|----------:|------:|\n",
                                    scene, resolution, "pass", width, "", width + 2);
    for (const vk::PassTime& pass : passes)
    {
        table += fmt::format("| {:<{}} | {:>9.3f} | {:>4.1f}% |\n", pass.name, width, pass.ms,
                             sum > 0 ? 100 * pass.ms / sum : 0.0);
    }
    return table;
}

Json benchJson(const BenchHeader& header, const std::vector<BenchRow>& rows)
{
    Json json = headJson("zvo.bench/1", header.device);
    json["width"] = header.width;
    json["height"] = header.height;
    json["runs"] = header.run_count;
    json["rows"] = Json::array();
    for (const BenchRow& row : rows)
    {
        json["rows"].push_back(rowJson(row));
    }
    return json;
}

} // namespace zvo::cli
