// SPDX-License-Identifier: MIT
#include "bench/bench_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace zvo::cli
{

namespace
{

template <typename T> Json orNull(const std::optional<T>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

Json spreadOrNull(const std::optional<Spread>& spread)
{
    return spread ? spreadJson(*spread) : Json(nullptr);
}

// Milliseconds of voxelization and octree construction.
std::optional<double> octreeMs(const BenchRow& row)
{
    return row.voxelize_ms && row.build_ms ? std::optional(row.voxelize_ms->median + row.build_ms->median)
                                           : std::nullopt;
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
    json["voxelize_ms"] = spreadOrNull(row.voxelize_ms);
    json["build_ms"] = spreadOrNull(row.build_ms);
    json["compress_ms"] = spreadOrNull(row.compress_ms);
    json["compress_ratio"] = orNull(row.compressRatio());
    json["dag_nodes"] = row.dag ? Json(row.dag->nodes) : Json(nullptr);
    json["dag_geometry_bytes"] = row.dag ? Json(row.dag->geometry_bytes) : Json(nullptr);
    json["dag_geometry_bytes_per_voxel"] = row.dag ? Json(row.perVoxel(row.dag->geometry_bytes)) : Json(nullptr);
    json["dag_geometry_ratio"] = orNull(row.dagGeometryRatio());
    json["dag_rank_bytes"] = row.dag ? Json(row.dag->rank_bytes) : Json(nullptr);
    json["trace_ms"] = spreadOrNull(row.trace_ms);
    json["trace_dag_ms"] = spreadOrNull(row.trace_dag_ms);
    json["trace_dag_ratio"] = spreadOrNull(row.trace_dag_ratio);
    json["mvoxels_per_s"] = orNull(row.mvoxelsPerSecond());
    json["mrays_per_s"] = orNull(row.mraysPerSecond());
    json["embree_user_mrays_per_s"] = orNull(row.embree_user_mrays_per_s);
    json["embree_triangle_mrays_per_s"] = orNull(row.embree_triangle_mrays_per_s);
    json["peak_device_bytes"] = row.peak_device_bytes;
    json["node_paths_ms"] = orNull(row.node_paths_ms);
    json["rays"] = orNull(row.rays);
    json["hits"] = orNull(row.hits);
    json["embree_user_hits"] = orNull(row.embree_user_hits);
    json["embree_user_single_mrays_per_s"] = orNull(row.embree_user_single_mrays_per_s);
    json["embree_triangle_single_mrays_per_s"] = orNull(row.embree_triangle_single_mrays_per_s);
    json["passes"] = passesJson(row.passes);
    json["kinds"] = rayKindsJson(row.kinds);
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

std::string cellText(const std::optional<double>& value, int digits)
{
    return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

std::string cellText(const std::optional<Spread>& spread)
{
    return spread ? spreadText(*spread) : "-";
}

Json spreadJson(const Spread& spread)
{
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

DagSize DagSize::of(const DeviceTree& dag)
{
    return {dag.node_count, dag.geometryBytes(), dag.lists.rankBytes()};
}

void BenchRow::setSizes(const DeviceTree& octree)
{
    voxels = octree.occupiedCount();
    nodes = octree.node_count;
    geometry_bytes = octree.geometryBytes();
    attribute_bytes = octree.attributeBytes();
}

double BenchRow::perVoxel(std::uint64_t bytes) const
{
    return voxels == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(voxels);
}

std::optional<double> BenchRow::mvoxelsPerSecond() const
{
    const std::optional<double> ms = octreeMs(*this);
    return ms && *ms > 0 ? std::optional(static_cast<double>(voxels) / *ms / 1e3) : std::nullopt;
}

std::optional<double> BenchRow::mraysPerSecond() const
{
    return rays && trace_ms && trace_ms->median > 0 ? std::optional(static_cast<double>(*rays) / trace_ms->median / 1e3)
                                                    : std::nullopt;
}

std::optional<double> BenchRow::dagGeometryRatio() const
{
    return dag && geometry_bytes != 0
               ? std::optional(static_cast<double>(dag->geometry_bytes) / static_cast<double>(geometry_bytes))
               : std::nullopt;
}

std::optional<double> BenchRow::compressRatio() const
{
    const std::optional<double> ms = octreeMs(*this);
    return compress_ms && ms && *ms > 0 ? std::optional(compress_ms->median / *ms) : std::nullopt;
}

Columns<BenchRow> octreeColumns()
{
    return {
        {"scene", 12, [](const BenchRow& row) { return row.scene; }},
        {"resolution", 10, [](const BenchRow& row) { return fmt::format("{}", row.resolution); }},
        {"coverage", 8, [](const BenchRow& row) { return std::string(coverageName(row.coverage)); }},
        {"triangles", 9, [](const BenchRow& row) { return fmt::format("{}", row.triangles); }},
        {"voxels", 9, [](const BenchRow& row) { return fmt::format("{}", row.voxels); }},
        {"nodes", 9, [](const BenchRow& row) { return fmt::format("{}", row.nodes); }},
    };
}

Column<BenchRow> peakColumn()
{
    constexpr double kMiB = 1 << 20;
    return {"peak MiB", 8, [](const BenchRow& row) {
                return fmt::format("{:.0f}", static_cast<double>(row.peak_device_bytes) / kMiB);
            }};
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

std::vector<vk::PassTime> ofDag(std::vector<vk::PassTime> passes)
{
    for (vk::PassTime& pass : passes)
    {
        pass.name += " (DAG)";
    }
    return passes;
}

Json benchJson(const BenchHeader& header, const std::vector<BenchRow>& rows)
{
    Json json = headJson("zvo.bench/1", header.device);
    json["width"] = orNull(header.width);
    json["height"] = orNull(header.height);
    json["runs"] = header.run_count;
    json["rows"] = Json::array();
    for (const BenchRow& row : rows)
    {
        json["rows"].push_back(rowJson(row));
    }
    return json;
}

} // namespace zvo::cli
