// SPDX-License-Identifier: MIT
#include "core/octree/octree_build.h"

#include "core/base/divide_up.h"
#include "core/base/lanes.h"
#include "core/base/tuning.h"
#include "core/tree/leaf_words.h"

#include <algorithm>
#include <cstddef>

namespace zvo
{

namespace
{

// Counts that a workgroup sums up by itself: more are scanned before.
constexpr std::uint64_t kBlocksUnscanned = 512;

void scanBlocks(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& partials, std::uint64_t skipped,
                std::uint64_t block_count, OctreeBuildBuffers& work)
{
    if (block_count > kBlocksUnscanned)
    {
        vk::Pass pass = graph.addPass(gpu::octree::Scan{});
        const gpu::ScanParams params = {{pass.readWrite(partials).address + skipped},
                                        pass.write(work.total),
                                        static_cast<std::uint32_t>(block_count)};
        pass.dispatch(gpu::kScanGroup, params);
    }
}

// Numbers the root and its children, of which level_count levels stand above the leaves.
void numberTop(vk::FrameGraph& graph, vk::BufferOf<gpu::BrickEntry>& table, OctreeBuildBuffers& work,
               DeviceTree& octree, std::size_t level_count)
{
    vk::Pass pass = graph.addPass(gpu::octree::Number{.wide_keys = hasWideKeys(octree.grid)});
    pass.dispatch(gpu::kRootGroup, {.bricks = pass.readWrite(table),
                                    .items = pass.read(work.items),
                                    .ranges = pass.read(work.ranges),
                                    .nodes = pass.readWrite(octree.nodes),
                                    .level_count = static_cast<std::uint32_t>(level_count),
                                    .root_children = level_count > 1 ? octree.levels[1].node_count : 0});
}

// Places the nodes of a level, whose first work item is given, and sets their child bases by a prefix sum.
void numberLevel(vk::FrameGraph& graph, vk::BufferOf<gpu::BrickEntry>& table, OctreeBuildBuffers& work,
                 DeviceTree& octree, std::size_t level, std::uint32_t first_item, std::uint64_t first_block)
{
    const auto [first_node, node_count] = octree.levels[level];
    const std::uint64_t block_count = divideUp(node_count, gpu::kScanBlock);
    const std::uint64_t skipped = first_block * sizeof(gpu::uint);
    {
        vk::Pass pass = graph.addPass(gpu::octree::Place{.wide_keys = hasWideKeys(octree.grid)});
        const std::uint32_t item_count = work.item_counts[level];
        pass.dispatch(item_count, {.bricks = pass.readWrite(table),
                                   .items = pass.read(work.items),
                                   .nodes = pass.readWrite(octree.nodes),
                                   .partials = {pass.readWrite(work.partials).address + skipped},
                                   .first_item = first_item,
                                   .first_node = first_node,
                                   .item_count = item_count});
    }
    scanBlocks(graph, work.partials, skipped, block_count, work);
    vk::Pass pass = graph.addPass(gpu::octree::Assign{});
    pass.dispatch(divideUp(node_count, gpu::kAssignItems), {.nodes = pass.readWrite(octree.nodes),
                                                            .partials = {pass.read(work.partials).address + skipped},
                                                            .is_scanned = block_count > kBlocksUnscanned ? 1U : 0U,
                                                            .first_node = first_node,
                                                            .node_count = node_count,
                                                            .first_child = first_node + node_count});
}

gpu::voxelize::BrickLeaves brickLeaves(const vk::Device& device, const Grid& grid, const VoxelForm& form,
                                       std::uint32_t fill_words)
{
    return {.wide_keys = hasWideKeys(grid),
            .mixed = form.mixed,
            .brick_lanes = tunedValue(device, Tunable::BrickLanes),
            .fill_words = fill_words};
}

// Numbers the voxels of bricks, and writes the nodes of leaves.
void numberLeaves(vk::FrameGraph& graph, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work, LeafBuffers& leaves,
                  DeviceTree& octree)
{
    const bool wide = hasWideKeys(octree.grid);
    // A grid of up to 4^3 is one leaf, of one brick, without a node for that.
    const std::size_t level_count = octree.levels.size();
    const auto [first_node, brick_count] = level_count > 1 ? octree.levels[level_count - 2] : DeviceTree::Level{0, 1};
    const std::uint64_t block_count = divideUp(brick_count, gpu::kScanBlock);
    const std::uint32_t item_count = level_count > 1 ? work.item_counts.back() : 1;
    graph.fill(work.brick_partials, 0);
    if (voxelize.fill_planes != 0)
    {
        graph.fill(work.order, gpu::kNoRange);
    }
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::PlaceBricks{.wide_keys = wide});
        pass.dispatch(item_count, {.bricks = pass.read(voxelize.table),
                                   .ranges = pass.read(voxelize.ranges),
                                   .work = pass.read(work.items),
                                   .work_bricks = pass.read(work.bricks),
                                   .order = pass.write(work.order),
                                   .partials = pass.readWrite(work.brick_partials),
                                   .first_node = first_node,
                                   .brick_count = item_count});
    }
    scanBlocks(graph, work.brick_partials, 0, block_count, work);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::BrickBases{});
        pass.dispatch(divideUp(brick_count, gpu::kAssignItems), {.ranges = pass.readWrite(voxelize.ranges),
                                                                 .order = pass.read(work.order),
                                                                 .partials = pass.read(work.brick_partials),
                                                                 .is_scanned = block_count > kBlocksUnscanned ? 1U : 0U,
                                                                 .brick_count = brick_count});
    }
    const std::uint32_t lanes = tunedValue(graph.device(), Tunable::BrickLanes);
    vk::Pass pass = graph.addPass(brickLeaves(graph.device(), octree.grid, voxelize.form, voxelize.fillWords()));
    pass.dispatch(std::uint64_t{brick_count} * lanes, {.bricks = pass.read(voxelize.table),
                                                       .ranges = pass.read(voxelize.ranges),
                                                       .order = pass.read(work.order),
                                                       .masks = pass.read(voxelize.masks),
                                                       .crossings = pass.read(voxelize.crossings),
                                                       .nodes = pass.readWrite(octree.nodes),
                                                       .mixed = pass.write(leaves.mixed),
                                                       .occupied = pass.write(leaves.occupied),
                                                       .first_leaf = octree.levels.back().first_node,
                                                       .brick_count = brick_count});
}

std::uint64_t partialCount(std::uint64_t table_capacity)
{
    return divideUp(table_capacity, gpu::kScanBlock) + gpu::kNodeLevelsMax;
}

} // namespace

OctreeBuildBuffers::OctreeBuildBuffers(vk::Device& device, std::uint64_t table_capacity, std::uint64_t brick_capacity)
    : items(device, "octree/items", table_capacity), counters(device, "octree/counters", 1),
      ranges(device, "octree/ranges", gpu::kNodeLevelsMax), args(device, "octree/args", gpu::kNodeLevelsMax),
      partials(device, "octree/partials", partialCount(table_capacity)), total(device, "octree/total", 1),
      bricks(device, "octree/bricks", brick_capacity), order(device, "octree/brick_order", brick_capacity),
      brick_partials(device, "octree/brick_partials", divideUp(brick_capacity, gpu::kScanBlock))
{
}

std::uint64_t OctreeBuildBuffers::bytes(std::uint64_t table_capacity, std::uint64_t brick_capacity)
{
    return table_capacity * sizeof(gpu::WorkItem) +
           (partialCount(table_capacity) + 2 * brick_capacity) * sizeof(gpu::uint);
}

void listNodes(vk::FrameGraph& graph, const GridTile& tile, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work)
{
    const Grid& grid = tile.grid;
    const std::uint32_t max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    graph.fill(work.counters, 0);
    graph.fill(work.ranges, 0);
    graph.fill(work.args, 0);
    {
        vk::Pass pass =
            graph.addPass(gpu::voxelize::CollectBricks{.mixed = voxelize.form.mixed,
                                                       .brick_lanes = tunedValue(graph.device(), Tunable::BrickLanes),
                                                       .fill_words = voxelize.fillWords()});
        pass.dispatchIndirect(voxelize.counters, &gpu::BinCounters::collect,
                              {.bricks = pass.readWrite(voxelize.table),
                               .ranges = pass.readWrite(voxelize.ranges),
                               .masks = pass.read(voxelize.masks),
                               .crossings = pass.read(voxelize.crossings),
                               .work = pass.write(work.items),
                               .work_bricks = pass.write(work.bricks),
                               .counters = pass.readWrite(voxelize.counters),
                               .nodes = pass.readWrite(work.counters),
                               .levels = pass.readWrite(work.ranges),
                               .args = pass.readWrite(work.args),
                               .max_groups_x = max_groups_x},
                              divideUp(voxelize.ranges.count(), gpu::kBricksGroup));
    }
    for (std::uint32_t height = 0; height + 2 < grid.nodeLevels(); ++height) // the root has no parent
    {
        vk::Pass pass = graph.addPass(gpu::octree::Parents{.wide_keys = hasWideKeys(grid)});
        pass.dispatchIndirect(work.args, height,
                              {.bricks = pass.readWrite(voxelize.table),
                               .items = pass.readWrite(work.items),
                               .counters = pass.readWrite(work.counters),
                               .ranges = pass.readWrite(work.ranges),
                               .args = pass.readWrite(work.args),
                               .brick_mask = static_cast<std::uint32_t>(voxelize.table.count() - 1),
                               .height = height,
                               .max_groups_x = max_groups_x},
                              divideUp(work.items.count(), gpu::kNodesGroup));
    }
}

void listFullNodes(vk::FrameGraph& graph, const GridTile& tile, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work)
{
    const Grid& grid = tile.grid;
    for (std::uint32_t height = 1; voxelize.fill_planes != 0 && height + 1 < grid.nodeLevels(); ++height)
    {
        vk::Pass pass = graph.addPass(
            gpu::voxelize::FillNodes{.wide_keys = hasWideKeys(grid), .robust = voxelize.form.fill == Fill::Robust});
        pass.dispatchIndirect(work.args, height,
                              {.bricks = pass.readWrite(voxelize.table),
                               .items = pass.read(work.items),
                               .ranges = pass.read(work.ranges),
                               .counters = pass.readWrite(work.counters),
                               .window = windowOf(tile),
                               .brick_mask = static_cast<std::uint32_t>(voxelize.table.count() - 1),
                               .height = height},
                              divideUp(work.items.count(), gpu::kNodesGroup));
    }
}

void numberNodes(vk::FrameGraph& graph, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work, LeafBuffers& leaves,
                 DeviceTree& octree)
{
    // Passes that put numbers where masks were cannot come twice: what can fail comes before the first of them.
    const bool wide = hasWideKeys(octree.grid);
    vk::KernelCache& kernels = graph.device().kernels();
    kernels.get(gpu::octree::Number{.wide_keys = wide});
    kernels.get(gpu::octree::Place{.wide_keys = wide});
    kernels.get(gpu::octree::Scan{});
    kernels.get(gpu::octree::Assign{});
    kernels.get(gpu::voxelize::PlaceBricks{.wide_keys = wide});
    kernels.get(gpu::voxelize::BrickBases{});
    kernels.get(brickLeaves(graph.device(), octree.grid, voxelize.form, voxelize.fillWords()));
    graph.fill(work.partials, 0);
    if (voxelize.fill_planes != 0)
    {
        graph.fill(octree.nodes, 0); // full nodes have no items that would write them
    }
    const std::size_t level_count = octree.levels.size() - 1; // without the leaves
    std::uint32_t item_end = 0;                               // the root is the last item
    for (std::size_t level = 0; level < level_count; ++level)
    {
        item_end += work.item_counts[level];
    }
    std::uint64_t first_block = 0;
    if (level_count != 0)
    {
        numberTop(graph, voxelize.table, work, octree, level_count);
    }
    for (std::size_t level = 0; level < level_count; ++level)
    {
        const std::uint32_t node_count = octree.levels[level].node_count;
        item_end -= work.item_counts[level];
        if (level >= gpu::kRootLevels)
        {
            numberLevel(graph, voxelize.table, work, octree, level, item_end, first_block);
            first_block += divideUp(node_count, gpu::kScanBlock);
        }
    }
    numberLeaves(graph, voxelize, work, leaves, octree);
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

void inheritColors(vk::FrameGraph& graph, DeviceTree& octree)
{
    for (std::size_t level = 0; level + 1 < octree.levels.size(); ++level)
    {
        const auto [first_node, node_count] = octree.levels[level];
        vk::Pass pass = graph.addPass(gpu::octree::Inherit{});
        pass.dispatch(node_count, {.nodes = pass.read(octree.nodes),
                                   .attributes = pass.readWrite(octree.node_attributes),
                                   .first_node = first_node,
                                   .node_count = node_count});
    }
}

void makeLeafWords(vk::FrameGraph& graph, const DeviceTree& octree, const vk::BufferOf<gpu::uvec2>& occupied,
                   vk::BufferOf<gpu::Node>& pool, vk::BufferOf<gpu::uvec2>& leaf_groups)
{
    const auto [first_leaf, leaf_count] = octree.levels.back();
    const bool is_filled = occupied.count() != 0;
    vk::Pass pass = graph.addPass(gpu::octree::LeafWords{.filled = is_filled});
    const gpu::Ptr<gpu::Node> to = pass.write(pool);
    pass.dispatch(std::max(octree.node_count, is_filled ? gpu::kFullNodeCount : 0U),
                  {.from = pass.read(octree.nodes),
                   .occupied = pass.read(occupied),
                   .to = to,
                   .surface = {to.address},
                   .leaf_groups = pass.write(leaf_groups),
                   .inner_count = first_leaf,
                   .leaf_count = leaf_count,
                   .first_parent = octree.levels[octree.levels.size() - 2].first_node,
                   .attribute_offset = firstLeafGroup(first_leaf, leaf_count, is_filled).y,
                   .first_full = is_filled ? firstFullNode(first_leaf, leaf_count) : 0U});
}

} // namespace zvo
