// SPDX-License-Identifier: MIT
// What `zvo-bench build` and `zvo-bench rays` tell of a scene at one resolution: a row of their tables and reports.
// Each measures a part of it.
#pragma once

#include "bench/ray_kind_rows.h"
#include "bench/table.h"
#include "common/report.h"
#include "core/tree/device_tree.h"
#include "vk/timer.h"
#include "zvo/types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

/// Median, least and greatest time of a row's runs.
struct Spread
{
    double median = 0;
    double min = 0;
    double max = 0;

    /// values: at least one.
    static Spread of(std::vector<double> values);
};

/// "median (min-max)" with two digits after the point.
std::string spreadText(const Spread& spread);

/// The text of a cell, "-" for nothing. digits: after the point; a spread has two.
std::string cellText(const std::optional<double>& value, int digits);
std::string cellText(const std::optional<Spread>& spread);

Json spreadJson(const Spread& spread);

/// The size of the DAG of a row's octree.
struct DagSize
{
    std::uint64_t nodes = 0;
    std::uint64_t geometry_bytes = 0; // of nodes and lists
    std::uint64_t rank_bytes = 0;     // additional bytes that attributes need

    static DagSize of(const DeviceTree& dag);
};

/// The numbers of one scene at one resolution. Those of a DAG are absent where memory does not suffice for octree and
/// DAG at once, and all that may be absent where the command does not measure them.
struct BenchRow
{
    std::string scene; // the file's name without its extension
    std::uint32_t resolution = 0;
    Coverage coverage = Coverage::Thin;
    bool attributes = true;
    std::uint64_t triangles = 0;
    std::uint64_t voxels = 0;
    std::uint64_t nodes = 0;
    std::uint64_t geometry_bytes = 0;
    std::uint64_t attribute_bytes = 0;
    std::uint64_t peak_device_bytes = 0; // until the octree was built, or traced
    std::optional<DagSize> dag;
    std::optional<Spread> voxelize_ms;
    std::optional<Spread> build_ms;
    std::optional<Spread> compress_ms;
    std::optional<Spread> trace_ms; // of the octree
    std::optional<Spread> trace_dag_ms;
    std::optional<Spread> trace_dag_ratio; // DAG / octree, of pictures that were traced in turns
    std::optional<double> node_paths_ms;   // once for each octree; not part of other times
    std::optional<std::uint64_t> rays;
    std::optional<std::uint64_t> hits;                    // rays that hit a voxel
    std::optional<double> embree_user_mrays_per_s;        // through the same voxels
    std::optional<std::uint64_t> embree_user_hits;        // of the same rays
    std::optional<double> embree_triangle_mrays_per_s;    // through the triangles
    std::optional<double> embree_user_single_mrays_per_s; // ray by ray
    std::optional<double> embree_triangle_single_mrays_per_s;
    std::vector<vk::PassTime> passes; // mean of the runs, summed by name
    std::vector<RayKindRow> kinds;

    void setSizes(const DeviceTree& octree);

    [[nodiscard]] double perVoxel(std::uint64_t bytes) const;
    [[nodiscard]] std::optional<double> mvoxelsPerSecond() const;
    [[nodiscard]] std::optional<double> mraysPerSecond() const;

    /// Bytes of geometry of the DAG, divided by those of the octree.
    [[nodiscard]] std::optional<double> dagGeometryRatio() const;
    /// Time of compression, divided by that of voxelization and octree construction.
    [[nodiscard]] std::optional<double> compressRatio() const;
};

/// What all rows have in common.
struct BenchHeader
{
    vk::DeviceReport device;
    std::optional<std::uint32_t> width; // of the traced pictures
    std::optional<std::uint32_t> height;
    std::uint32_t run_count = 0;
};

/// What the tables of both commands begin with: the scene, and what its octree has.
Columns<BenchRow> octreeColumns();

/// The last column of both tables.
Column<BenchRow> peakColumn();

/// A table of the passes' times.
std::string passTable(const std::string& scene, std::uint32_t resolution, const std::vector<vk::PassTime>& passes);

/// Marks passes as those of compression and the DAG's pictures, apart from those of the octree.
std::vector<vk::PassTime> ofDag(std::vector<vk::PassTime> passes);

/// The report of both commands; the names of the fields are an interface. What is absent is null.
Json benchJson(const BenchHeader& header, const std::vector<BenchRow>& rows);

} // namespace zvo::cli
