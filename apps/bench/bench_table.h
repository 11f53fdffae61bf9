// SPDX-License-Identifier: MIT
#pragma once

#include "common/report.h"
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

Json spreadJson(const Spread& spread);

constexpr std::uint32_t kTraceTurns = 3; // pictures for each run, as they take less time than the rest

/// The numbers of a row about the DAG of its octree.
struct DagNumbers
{
    std::uint64_t nodes = 0;
    std::uint64_t geometry_bytes = 0; // of nodes and lists
    std::uint64_t rank_bytes = 0;     // additional bytes that attributes need
    Spread compress_ms;
    Spread trace_ms;
    Spread trace_ratio; // DAG / octree, of pictures that were traced in turns
};

/// The numbers of one scene at one resolution.
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
    std::uint64_t peak_device_bytes = 0; // until the octree was traced
    Spread voxelize_ms;
    Spread build_ms;
    Spread trace_ms;               // of the octree
    std::optional<DagNumbers> dag; // nothing if memory does not suffice for octree and DAG at once
    double node_paths_ms = 0;      // once for each octree; not part of other times
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;                               // rays that hit a voxel
    std::optional<double> embree_user_mrays_per_s;        // through the same voxels
    std::optional<std::uint64_t> embree_user_hits;        // of the same rays
    std::optional<double> embree_triangle_mrays_per_s;    // through the triangles
    std::optional<double> embree_user_single_mrays_per_s; // ray by ray
    std::optional<double> embree_triangle_single_mrays_per_s;
    std::vector<vk::PassTime> passes; // mean of the runs, summed by name

    [[nodiscard]] double perVoxel(std::uint64_t bytes) const;
    [[nodiscard]] double mvoxelsPerSecond() const;
    [[nodiscard]] double mraysPerSecond() const;

    /// Bytes of geometry of the DAG, divided by those of the octree.
    [[nodiscard]] double dagGeometryRatio(const DagNumbers& numbers) const;
    /// Time of compression, divided by that of voxelization and octree construction.
    [[nodiscard]] double compressRatio(const DagNumbers& numbers) const;
};

/// What all rows have in common.
struct BenchHeader
{
    vk::DeviceReport device;
    std::uint32_t width = 0; // of the traced pictures
    std::uint32_t height = 0;
    std::uint32_t run_count = 0;
};

/// The head of the table, in Markdown: a sentence on the conditions, and the columns' names.
std::string tableHead(const BenchHeader& header);

/// One line of the table.
std::string tableLine(const BenchRow& row);

/// A table of the passes' times.
std::string passTable(const std::string& scene, std::uint32_t resolution, const std::vector<vk::PassTime>& passes);

/// The report of `zvo bench`; the names of the fields are an interface.
Json benchJson(const BenchHeader& header, const std::vector<BenchRow>& rows);

} // namespace zvo::cli
