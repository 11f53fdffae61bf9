// SPDX-License-Identifier: MIT
#include "core/octree/octree_build.h"

#include "core/base/divide_up.h"
#include "core/base/lanes.h"
#include "core/tree/leaf_words.h"

namespace zvo
{

namespace
{

// Child counts that octree/assign sums up by itself: more are scanned before.
constexpr std::uint64_t kBlocksUnscanned = 512;

// Numbers the root and its children, of which level_count levels are numbered at all.
void numberTop(vk::FrameGraph& graph, vk::BufferOf<gpu::BrickEntry>& table, OctreeBuildBuffers& work,
               DeviceTree& octree, std::size_t level_count)
{
    vk::Pass pass = graph.addPass(gpu::octree::Number{.wide_keys = hasWideKeys(octree.grid)});
    pass.dispatch(gpu::kRootGroup, {.bricks = pass.readWrite(table),
                                    .items = pass.read(work.items),
                                    .ranges = pass.read(work.ranges),
                                    .nodes = pass.readWrite(octree.nodes),
                                    .level_count = static_cast<std::uint32_t>(level_count),
                                    .leaf_level = static_cast<std::uint32_t>(octree.levels.size() - 1)});
}

// Places the nodes of a level, whose first work item is given, and sets their child bases by a prefix sum.
void numberLevel(vk::FrameGraph& graph, vk::BufferOf<gpu::BrickEntry>& table, OctreeBuildBuffers& work,
                 DeviceTree& octree, std::size_t level, std::uint32_t first_item, std::uint64_t first_block)
{
    const auto [first_node, node_count] = octree.levels[level];
    const bool are_leaves = level + 1 == octree.levels.size();
    const std::uint64_t block_count = divideUp(node_count, gpu::kScanBlock);
    const std::uint64_t skipped = first_block * sizeof(gpu::uint);
    {
        vk::Pass pass = graph.addPass(gpu::octree::Place{.wide_keys = hasWideKeys(octree.grid)});
        pass.dispatch(node_count, {.bricks = pass.readWrite(table),
                                   .items = pass.read(work.items),
                                   .nodes = pass.readWrite(octree.nodes),
                                   .partials = {pass.readWrite(work.partials).address + skipped},
                                   .first_item = first_item,
                                   .first_node = first_node,
                                   .node_count = node_count});
    }
    if (block_count > kBlocksUnscanned)
    {
        vk::Pass pass = graph.addPass(gpu::octree::Scan{});
        const gpu::ScanParams params = {{pass.readWrite(work.partials).address + skipped},
                                        pass.write(work.total),
                                        static_cast<std::uint32_t>(block_count)};
        pass.dispatch(gpu::kScanGroup, params);
    }
    vk::Pass pass = graph.addPass(gpu::octree::Assign{});
    pass.dispatch(divideUp(node_count, gpu::kAssignItems),
                  {.nodes = pass.readWrite(octree.nodes),
                   .bricks = pass.readWrite(table),
                   .partials = {pass.read(work.partials).address + skipped},
                   .is_scanned = block_count > kBlocksUnscanned ? 1U : 0U,
                   .first_node = first_node,
                   .node_count = node_count,
                   .first_child = are_leaves ? 0 : first_node + node_count,
                   .tell_bricks = are_leaves && !hasWideKeys(octree.grid) ? 1U : 0U});
}

// Adds the ancestors of the listed nodes to list and table. level_count: from the listed level to the root.
void listParents(vk::FrameGraph& graph, std::uint32_t level_count, bool wide_keys, vk::BufferOf<gpu::BrickEntry>& table,
                 vk::BufferOf<gpu::BrickCounters>& counters, OctreeBuildBuffers& work, std::uint64_t brick_capacity)
{
    for (std::uint32_t height = 0; height + 1 < level_count; ++height) // the root has no parent
    {
        vk::Pass pass = graph.addPass(gpu::octree::Parents{.wide_keys = wide_keys});
        pass.dispatchIndirect(work.args, height,
                              {.bricks = pass.readWrite(table),
                               .items = pass.readWrite(work.items),
                               .counters = pass.readWrite(counters),
                               .ranges = pass.readWrite(work.ranges),
                               .args = pass.readWrite(work.args),
                               .brick_mask = static_cast<std::uint32_t>(brick_capacity - 1),
                               .height = height,
                               .max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0]},
                              divideUp(work.items.count(), gpu::kNodesGroup));
    }
}

} // namespace

OctreeBuildBuffers::OctreeBuildBuffers(vk::Device& device, std::uint64_t brick_capacity)
    : items(device, "octree/items", brick_capacity), ranges(device, "octree/ranges", gpu::kNodeLevelsMax),
      args(device, "octree/args", gpu::kNodeLevelsMax),
      partials(device, "octree/partials", divideUp(brick_capacity, gpu::kScanBlock) + gpu::kNodeLevelsMax),
      total(device, "octree/total", 1)
{
}

void listNodes(vk::FrameGraph& graph, const Grid& grid, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work)
{
    graph.fill(work.ranges, 0);
    graph.fill(work.args, 0);
    const std::uint32_t max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    {
        vk::Pass pass = graph.addPass(gpu::octree::Collect{.mixed = voxelize.sum_form.mixed});
        pass.dispatch(divideUp(voxelize.brickCapacity(), gpu::kCollectItems),
                      {.bricks = pass.readWrite(voxelize.bricks),
                       .items = pass.write(work.items),
                       .counters = pass.readWrite(voxelize.counters),
                       .ranges = pass.readWrite(work.ranges),
                       .args = pass.readWrite(work.args),
                       .brick_capacity = static_cast<std::uint32_t>(voxelize.brickCapacity()),
                       .max_groups_x = max_groups_x});
    }
    listParents(graph, grid.nodeLevels(), hasWideKeys(grid), voxelize.bricks, voxelize.counters, work,
                voxelize.brickCapacity());
}

void listBricks(vk::FrameGraph& graph, const Grid& grid, BrickBuffers& bricks, OctreeBuildBuffers& work)
{
    graph.fill(work.ranges, 0);
    graph.fill(work.args, 0);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::CollectBricks{.mixed = bricks.has_mixed});
        pass.dispatchIndirect(bricks.counters, &gpu::BinCounters::collect,
                              {.bricks = pass.readWrite(bricks.table),
                               .ranges = pass.readWrite(bricks.ranges),
                               .masks = pass.read(bricks.masks),
                               .work = pass.write(work.items),
                               .work_bricks = pass.write(bricks.work_bricks),
                               .counters = pass.readWrite(bricks.counters),
                               .nodes = pass.readWrite(bricks.nodes),
                               .levels = pass.readWrite(work.ranges),
                               .args = pass.readWrite(work.args),
                               .max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0]},
                              divideUp(bricks.ranges.count(), gpu::kBricksGroup));
    }
    listParents(graph, grid.nodeLevels() - 1, hasWideKeys(grid), bricks.table, bricks.nodes, work,
                bricks.table.count());
}

void numberNodes(vk::FrameGraph& graph, vk::BufferOf<gpu::BrickEntry>& table, OctreeBuildBuffers& work,
                 DeviceTree& octree, std::size_t level_count)
{
    // Passes that put numbers where masks were cannot come twice: what can fail comes before the first of them.
    vk::KernelCache& kernels = graph.device().kernels();
    kernels.get(gpu::octree::Number{.wide_keys = hasWideKeys(octree.grid)});
    kernels.get(gpu::octree::Place{.wide_keys = hasWideKeys(octree.grid)});
    kernels.get(gpu::octree::Scan{});
    kernels.get(gpu::octree::Assign{});
    graph.fill(work.partials, 0);
    std::uint32_t item_end = 0; // the root is the last item
    for (std::size_t level = 0; level < level_count; ++level)
    {
        item_end += octree.levels[level].node_count;
    }
    std::uint64_t first_block = 0;
    numberTop(graph, table, work, octree, level_count);
    for (std::size_t level = 0; level < level_count; ++level)
    {
        const std::uint32_t node_count = octree.levels[level].node_count;
        item_end -= node_count;
        if (level >= gpu::kRootLevels)
        {
            numberLevel(graph, table, work, octree, level, item_end, first_block);
            first_block += divideUp(node_count, gpu::kScanBlock);
        }
    }
}

static_assert(kLoneNodes == gpu::kNodesGroup);

void averageNodes(vk::FrameGraph& graph, const GpuScene& scene, DeviceTree& octree)
{
    std::size_t level = octree.levels.size();
    for (; level > gpu::kRootLevels; --level)
    {
        const bool is_leaf = level == octree.levels.size();
        const auto [first_node, node_count] = octree.levels[level - 1];
        const std::uint32_t lanes = lanesOn(graph.device(), node_count);
        vk::Pass pass = graph.addPass(gpu::octree::Average{.lanes = lanes});
        pass.dispatch(std::uint64_t{node_count} * lanes,
                      {.scene = readColorTables(pass, scene),
                       .nodes = pass.read(octree.nodes),
                       .children = is_leaf ? pass.read(octree.voxel_attributes) : pass.read(octree.node_attributes),
                       .averages = pass.readWrite(octree.node_attributes),
                       .leaf_groups = pass.read(octree.leaf_groups),
                       .first_node = first_node,
                       .node_count = node_count,
                       .reference = is_leaf ? octree.leafReference() : 0,
                       .child_reference = level + 1 == octree.levels.size() ? octree.leafReference() : 0});
    }
    if (level == 0)
    {
        return;
    }
    const bool are_leaves = level == octree.levels.size();
    const std::uint32_t threads = loneGroupOn(graph.device());
    const std::uint32_t lanes = lanesOn(graph.device());
    vk::Pass pass = graph.addPass(gpu::octree::AverageTop{.lanes = lanes, .local_size_x = threads});
    gpu::AverageTopParams params{};
    params.scene = readColorTables(pass, scene);
    params.nodes = pass.read(octree.nodes);
    params.averages = pass.readWrite(octree.node_attributes);
    params.lowest_children =
        are_leaves ? pass.read(octree.voxel_attributes) : gpu::ConstPtr<gpu::Attribute>{params.averages.address};
    for (std::size_t i = 0; i < level; ++i)
    {
        params.levels[i] = {octree.levels[i].first_node, octree.levels[i].node_count};
    }
    params.leaf_groups = pass.read(octree.leaf_groups);
    params.level_count = static_cast<gpu::uint>(level);
    params.leaf_level = static_cast<gpu::uint>(octree.levels.size() - 1);
    params.leaf_reference = octree.leafReference();
    pass.dispatch(threads, params);
}

void makeLeafWords(vk::FrameGraph& graph, const DeviceTree& octree, vk::BufferOf<gpu::Node>& pool,
                   vk::BufferOf<gpu::uvec2>& leaf_groups)
{
    const auto [first_leaf, leaf_count] = octree.levels.back();
    vk::Pass pass = graph.addPass(gpu::octree::LeafWords{});
    pass.dispatch(octree.node_count, {.from = pass.read(octree.nodes),
                                      .to = pass.write(pool),
                                      .leaf_groups = pass.write(leaf_groups),
                                      .inner_count = first_leaf,
                                      .leaf_count = leaf_count,
                                      .first_parent = octree.levels[octree.levels.size() - 2].first_node,
                                      .attribute_offset = firstLeafGroup(first_leaf, leaf_count).y});
}

} // namespace zvo
