// SPDX-License-Identifier: MIT
// What `zvo-bench build` and `zvo-bench rays` have in common: rows of scenes at resolutions.
#pragma once

#include "bench/bench_options.h"
#include "bench/bench_table.h"
#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "core/upload/gpu_scene.h"
#include "vk/headless.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace zvo::cli
{

/// What a row is measured of.
struct BenchSubject
{
    const Scene& scene;
    const GpuScene& uploaded;
    Grid grid;
};

/// What a command tells.
struct RowTable
{
    std::string conditions; // sentences above the table
    Columns<BenchRow> columns;
    std::optional<std::uint32_t> width; // of the traced pictures
    std::optional<std::uint32_t> height;
};

/// Measures the scenes of options at each resolution; prints a table, JSON, or both. measure: fills what rows have
/// beside scene, resolution, triangles, coverage and attributes. Throws Error.
void measureRows(const PassBenchOptions& options, const RowTable& table,
                 const std::function<void(vk::HeadlessDevice&, const BenchSubject&, BenchRow&)>& measure);

/// "N warm runs"
std::string warmRuns(std::uint32_t run_count);

/// Does work that makes the DAG of a row's octree. Returns false, with a warning, if memory does not suffice for both.
bool withDag(const BenchRow& row, const std::function<void()>& work);

} // namespace zvo::cli
