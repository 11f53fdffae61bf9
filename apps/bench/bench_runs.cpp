// SPDX-License-Identifier: MIT
#include "bench/bench_runs.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace zvo::cli
{

void addPasses(std::vector<vk::PassTime>& sums, std::vector<vk::PassTime> passes, std::uint32_t run_count)
{
    for (vk::PassTime& pass : passes)
    {
        pass.ms /= run_count;
        sums.push_back(std::move(pass));
    }
    sums = sumByName(sums);
}

bool voxelizesObjects(const std::string& pass)
{
    constexpr std::string_view kParts[] = {"voxelize/", "update/layer_", "mover/", "deform/"};
    return std::ranges::any_of(kParts, [&](std::string_view part) { return pass.find(part) != std::string::npos; });
}

BuildRuns measureBuild(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid, BuildOptions options,
                       std::uint32_t run_count)
{
    warmUp(device, [&] { options.capacities = buildOctree(device, scene, grid, options).capacities; });
    BuildRuns runs;
    std::vector<double> voxelize_ms;
    std::vector<double> build_ms;
    std::vector<double> total_ms;
    for (std::uint32_t run = 0; run < run_count; ++run)
    {
        runs.last = {}; // frees its memory before the next one is made
        runs.last = buildOctree(device, scene, grid, options);
        voxelize_ms.push_back(runs.last.operationMs("voxelize"));
        build_ms.push_back(runs.last.operationMs("octree"));
        total_ms.push_back(voxelize_ms.back() + build_ms.back());
        addPasses(runs.passes, runs.last.passes, run_count);
    }
    runs.voxelize_ms = Spread::of(voxelize_ms);
    runs.build_ms = Spread::of(build_ms);
    runs.total_ms = Spread::of(total_ms);
    return runs;
}

} // namespace zvo::cli
