// SPDX-License-Identifier: MIT
// The runs of a measurement.
#pragma once

#include "bench/bench_table.h"
#include "core/base/grid.h"
#include "core/headless/pipeline.h"
#include "core/upload/gpu_scene.h"

#include <cstdint>
#include <vector>

namespace zvo::cli
{

/// Adds passes, each divided by run_count, to sums of the same names; both in order of occurrence.
void addPasses(std::vector<vk::PassTime>& sums, std::vector<vk::PassTime> passes, std::uint32_t run_count);

/// Voxelization and octree construction, on the device's timers.
struct BuildRuns
{
    Spread voxelize_ms;
    Spread build_ms;
    Spread total_ms;                  // of both
    std::vector<vk::PassTime> passes; // mean of the runs, summed by name
    BuildResult last;
};

/// run_count runs, at least one, after a warm-up that also finds out how much room they need.
BuildRuns measureBuild(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid, BuildOptions options,
                       std::uint32_t run_count);

} // namespace zvo::cli
