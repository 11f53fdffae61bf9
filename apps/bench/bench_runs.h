// SPDX-License-Identifier: MIT
// Repeated measurements.
#pragma once

#include "bench/bench_table.h"
#include "core/base/grid.h"
#include "core/upload/gpu_scene.h"
#include "runtime/trees.h"
#include "vk/headless.h"
#include "vk/timer.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace zvo::cli
{

/// For how long GPUs are warmed up: after a pause they raise their clocks within a second or two.
inline constexpr std::chrono::milliseconds kWarmUp{2500};

/// Does work that is measured later: once, which makes its kernels, and then on GPUs until they have run for kWarmUp.
template <typename Work> void warmUp(vk::HeadlessDevice& device, const Work& work)
{
    work();
    const auto begin = std::chrono::steady_clock::now();
    while (device.device().report().type != "cpu" && std::chrono::steady_clock::now() - begin < kWarmUp)
    {
        work();
    }
}

/// Adds passes, each divided by run_count, to the sums with the same names. Both stay in order of occurrence.
void addPasses(std::vector<vk::PassTime>& sums, std::vector<vk::PassTime> passes, std::uint32_t run_count);

/// Whether a pass of an update belongs to the voxelization of dynamic objects.
bool voxelizesObjects(const std::string& pass);

/// Times of voxelization and octree construction, by the device's timers.
struct BuildRuns
{
    Spread voxelize_ms;
    Spread build_ms;
    Spread total_ms;                  // of both
    std::vector<vk::PassTime> passes; // mean of the runs, summed by name
    BuildResult last;
};

/// Measures run_count runs, at least one, after a warm-up that also finds the room they need.
BuildRuns measureBuild(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid, BuildOptions options,
                       std::uint32_t run_count);

} // namespace zvo::cli
