// SPDX-License-Identifier: MIT
#include "baseline/crassin_green_build.h"

#include "core/base/divide_up.h"
#include "core/tree/tree_limits.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace zvo::baseline
{

namespace
{

constexpr std::uint64_t kNodesMin = 1 << 12;
constexpr std::uint64_t kNodesAFragment = 4; // a guess

// The parameters of a pass, all of whose kernels take the same.
gpu::CrassinGreenParams paramsOf(vk::AnyPass& pass, const CrassinGreenJob& job, std::uint32_t level)
{
    gpu::CrassinGreenParams params{};
    params.fragments = pass.read(job.fragments);
    params.nodes = pass.readWrite(job.octree.nodes);
    params.ranges = pass.readWrite(job.buffers.ranges);
    params.args = pass.readWrite(job.buffers.args);
    params.tile_count = pass.readWrite(job.buffers.tile_count);
    params.sums = pass.readWrite(job.buffers.sums);
    params.scene = readColorTables(pass, job.scene);
    params.fragment_count = static_cast<std::uint32_t>(job.fragments.count());
    params.node_capacity = static_cast<std::uint32_t>(job.octree.nodes.count());
    params.sum_capacity = static_cast<std::uint32_t>(job.buffers.sums.count());
    params.level = level;
    params.depth = job.octree.grid.depth;
    return params;
}

// Records a pass over the fragments.
template <typename Kernel>
void takeFragments(vk::FrameGraph& graph, const CrassinGreenJob& job, std::uint32_t level, const Kernel& kernel)
{
    vk::Pass pass = graph.addPass(kernel);
    pass.dispatch(job.fragments.count(), paramsOf(pass, job, level));
}

// Records a pass over the nodes of a level, whose number the device knows.
template <typename Kernel>
void takeNodes(vk::FrameGraph& graph, const CrassinGreenJob& job, std::uint32_t level, const Kernel& kernel)
{
    vk::Pass pass = graph.addPass(kernel);
    const gpu::CrassinGreenParams params = paramsOf(pass, job, level);
    pass.dispatchIndirect(job.buffers.args, level, params,
                          divideUp(job.octree.nodes.count(), gpu::kCrassinGreenGroup) + gpu::kGroupsXMax);
}

} // namespace

CrassinGreenBuffers::CrassinGreenBuffers(vk::Device& device)
    : ranges(device, "baseline/crassin_green_ranges", gpu::kCrassinGreenLevels),
      args(device, "baseline/crassin_green_args", gpu::kCrassinGreenLevels),
      tile_count(device, "baseline/crassin_green_tile_count", 1)
{
}

void makeNodes(vk::FrameGraph& graph, const CrassinGreenJob& job)
{
    const gpu::LevelRange root_range{.first = 0, .count = 1};
    const gpu::DispatchArgs root_args{.x = 1, .y = 1, .z = 1};
    const gpu::PointerNode root{.child = 0, .color = 0, .normal = 0};
    graph.update(job.buffers.ranges, 0, std::span(&root_range, 1));
    graph.update(job.buffers.args, 0, std::span(&root_args, 1));
    graph.update(job.octree.nodes, 0, std::span(&root, 1));
    graph.fill(job.buffers.tile_count, 0);
    for (std::uint32_t level = 0; level < job.octree.grid.depth; ++level)
    {
        takeFragments(graph, job, level, gpu::baseline::CrassinGreenFlag{});
        takeNodes(graph, job, level, gpu::baseline::CrassinGreenAllocate{});
        vk::Pass pass = graph.addPass(gpu::baseline::CrassinGreenNext{});
        pass.dispatch(gpu::kCrassinGreenGroup, paramsOf(pass, job, level));
        takeNodes(graph, job, level + 1, gpu::baseline::CrassinGreenClear{});
    }
}

void averageNodes(vk::FrameGraph& graph, const CrassinGreenJob& job)
{
    const std::uint32_t depth = job.octree.grid.depth;
    graph.fill(job.buffers.sums, 0);
    takeFragments(graph, job, depth, gpu::baseline::CrassinGreenAdd{});
    takeNodes(graph, job, depth, gpu::baseline::CrassinGreenResolve{});
    for (std::uint32_t level = depth; level-- > 0;)
    {
        takeNodes(graph, job, level, gpu::baseline::CrassinGreenMipmap{});
    }
}

CrassinGreenBuild buildTopDown(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid,
                               const vk::BufferOf<gpu::VoxelFragment>& fragments, CrassinGreenBuffers& buffers)
{
    requireDepth(grid, gpu::kPointerDepthMax, "the construction of Crassin and Green");
    CrassinGreenBuild result;
    PointerOctree& octree = result.octree;
    octree.grid = grid;
    const CrassinGreenJob job = {scene, fragments, buffers, octree};
    std::uint64_t needed = std::max(kNodesMin, kNodesAFragment * fragments.count());
    while (needed > octree.nodes.count())
    {
        requireIndexable(needed, 0);
        octree.nodes = {}; // before the larger buffer is made
        octree.nodes = {device.device(), "baseline/pointer_nodes", needed};
        result.passes = device.run([&](vk::FrameGraph& graph) { makeNodes(graph, job); });
        // Where there was no room, levels below are missing: that many are known to be needed, and as many again.
        needed = 1 + gpu::kTileNodes * std::uint64_t{device.download(buffers.tile_count).front()};
        octree.node_count = static_cast<std::uint32_t>(needed);
        needed = needed > octree.nodes.count() ? 2 * needed : needed;
    }
    buffers.sums = {};
    buffers.sums = {device.device(), "baseline/crassin_green_sums", device.download(buffers.ranges)[grid.depth].count};
    std::vector<vk::PassTime> more = device.run([&](vk::FrameGraph& graph) { averageNodes(graph, job); });
    result.passes.insert(result.passes.end(), std::make_move_iterator(more.begin()),
                         std::make_move_iterator(more.end()));
    return result;
}

} // namespace zvo::baseline
