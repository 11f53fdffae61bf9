// SPDX-License-Identifier: MIT
#include "core/octree/octree_build.h"

#include "core/base/divide_up.h"

namespace zvo
{

namespace
{

// Sets the child bases of one level by a prefix sum over its nodes.
void assignChildren(vk::FrameGraph& graph, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work, DeviceTree& octree,
                    std::size_t level)
{
    const auto [first_node, node_count] = octree.levels[level];
    const bool is_leaf = level + 1 == octree.levels.size();
    const std::uint64_t threads = divideUp(node_count, gpu::kScanItems);
    {
        vk::Pass pass = graph.addPass(gpu::octree::Count{});
        const gpu::CountParams params = {pass.read(octree.nodes), pass.write(work.partials), first_node, node_count};
        pass.dispatch(threads, params);
    }
    {
        vk::Pass pass = graph.addPass(gpu::octree::Scan{});
        const gpu::ScanParams params = {pass.readWrite(work.partials), pass.write(work.total),
                                        static_cast<std::uint32_t>(divideUp(node_count, gpu::kScanBlock))};
        pass.dispatch(gpu::kScanGroup, params);
    }
    vk::Pass pass = graph.addPass(gpu::octree::Assign{});
    gpu::AssignParams params{};
    params.nodes = pass.readWrite(octree.nodes);
    params.bricks = pass.readWrite(voxelize.bricks);
    params.partials = pass.read(work.partials);
    params.first_node = first_node;
    params.node_count = node_count;
    params.first_child = is_leaf ? 0 : first_node + node_count;
    params.tell_bricks = is_leaf && !hasWideKeys(octree.grid) ? 1 : 0;
    pass.dispatch(threads, params);
}

} // namespace

OctreeBuildBuffers::OctreeBuildBuffers(vk::Device& device, std::uint64_t brick_capacity)
    : items(device, "octree/items", brick_capacity), ranges(device, "octree/ranges", gpu::kNodeLevelsMax),
      args(device, "octree/args", gpu::kNodeLevelsMax),
      partials(device, "octree/partials", divideUp(brick_capacity, gpu::kScanBlock)), total(device, "octree/total", 1)
{
}

void listNodes(vk::FrameGraph& graph, const Grid& grid, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work)
{
    {
        vk::Pass pass = graph.addPass(gpu::octree::Collect{});
        const gpu::CollectParams params = {pass.read(voxelize.bricks), pass.write(work.items),
                                           pass.readWrite(voxelize.counters),
                                           static_cast<std::uint32_t>(voxelize.bricks.count())};
        pass.dispatch(divideUp(voxelize.bricks.count(), gpu::kCollectItems), params);
    }
    listAncestors(graph, grid, voxelize.bricks, voxelize.counters, work);
}

void listAncestors(vk::FrameGraph& graph, const Grid& grid, vk::BufferOf<gpu::BrickEntry>& bricks,
                   vk::BufferOf<gpu::BrickCounters>& counters, OctreeBuildBuffers& work)
{
    for (std::uint32_t height = 0; height < grid.nodeLevels(); ++height)
    {
        {
            vk::Pass pass = graph.addPass(gpu::octree::NextLevel{});
            gpu::NextLevelParams params{};
            params.counters = pass.read(counters);
            params.ranges = pass.readWrite(work.ranges);
            params.args = pass.write(work.args);
            params.height = height;
            params.max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
            pass.dispatch(1, params);
        }
        if (height + 1 == grid.nodeLevels()) // the root has no parent
        {
            break;
        }
        vk::Pass pass = graph.addPass(gpu::octree::Parents{.wide_keys = hasWideKeys(grid)});
        gpu::ParentsParams params{};
        params.bricks = pass.readWrite(bricks);
        params.items = pass.readWrite(work.items);
        params.counters = pass.readWrite(counters);
        params.ranges = pass.read(work.ranges);
        params.brick_mask = static_cast<std::uint32_t>(bricks.count() - 1);
        params.height = height;
        pass.dispatchIndirect(work.args, height, params, divideUp(work.items.count(), gpu::kNodesGroup));
    }
}

void numberNodes(vk::FrameGraph& graph, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work, DeviceTree& octree)
{
    // Passes that put numbers where masks were cannot come twice: what can fail comes before the first of them.
    const gpu::octree::Place place{.wide_keys = hasWideKeys(octree.grid)};
    vk::KernelCache& kernels = graph.device().kernels();
    kernels.get(place);
    kernels.get(gpu::octree::Count{});
    kernels.get(gpu::octree::Scan{});
    kernels.get(gpu::octree::Assign{});
    std::uint32_t item_end = octree.node_count; // the root is the last item
    for (std::size_t level = 0; level < octree.levels.size(); ++level)
    {
        const std::uint32_t node_count = octree.levels[level].node_count;
        {
            vk::Pass pass = graph.addPass(place);
            gpu::PlaceParams params{};
            params.bricks = pass.readWrite(voxelize.bricks);
            params.items = pass.read(work.items);
            params.nodes = pass.readWrite(octree.nodes);
            params.first_item = item_end - node_count;
            params.node_count = node_count;
            params.is_root = level == 0 ? 1 : 0;
            pass.dispatch(node_count, params);
        }
        item_end -= node_count;
        assignChildren(graph, voxelize, work, octree, level);
    }
}

void averageNodes(vk::FrameGraph& graph, const GpuScene& scene, DeviceTree& octree)
{
    for (std::size_t level = octree.levels.size(); level-- > 0;)
    {
        const bool is_leaf = level + 1 == octree.levels.size();
        const auto [first_node, node_count] = octree.levels[level];
        vk::Pass pass = graph.addPass(gpu::octree::Average{});
        gpu::AverageParams params{};
        params.scene = pass.read(scene.view);
        params.nodes = pass.read(octree.nodes);
        params.children = is_leaf ? pass.read(octree.voxel_attributes) : pass.read(octree.node_attributes);
        params.averages = pass.readWrite(octree.node_attributes);
        params.first_node = first_node;
        params.node_count = node_count;
        pass.dispatch(node_count, params);
    }
}

} // namespace zvo
