// SPDX-License-Identifier: MIT
#include "core/octree/brick_octree.h"

#include "core/base/divide_up.h"
#include "core/tree/leaf_words.h"
#include "core/tree/tree_limits.h"

#include <utility>

namespace zvo
{

BrickCountOffsets copyCounts(vk::FrameGraph& graph, vk::Readback& readback, const OctreeBricks& bricks,
                             std::uint32_t level_count)
{
    return {.bins = readback.copy(graph, bricks.voxelize.counters, 0, 1),
            .nodes = readback.copy(graph, bricks.work.counters, 0, 1),
            .ranges = readback.copy(graph, bricks.work.ranges, 0, level_count)};
}

BrickCounts readCounts(const vk::Readback& readback, const BrickCountOffsets& offsets, std::uint32_t level_count)
{
    const auto listed = readback.at<gpu::LevelRange>(offsets.ranges, level_count - 1);
    return {.bins = readback.at<gpu::BinCounters>(offsets.bins, 1).front(),
            .nodes = readback.at<gpu::BrickCounters>(offsets.nodes, 1).front(),
            .listed = {listed.begin(), listed.end()}};
}

void allocateNodes(vk::Device& device, const BrickCounts& counts, OctreeBricks& bricks, DeviceTree& octree)
{
    const gpu::BinCounters& bins = counts.bins;
    const std::uint32_t level_count = octree.grid.nodeLevels();
    std::uint32_t inner_count = level_count > 1 ? counts.nodes.node_count : 0;
    octree.interior_count = bins.filled_lo + (std::uint64_t{bins.filled_hi} << 32);
    for (std::uint32_t height = 0; height + 1 < level_count; ++height)
    {
        inner_count += counts.nodes.full_nodes[height];
        octree.interior_count += std::uint64_t{counts.nodes.full_nodes[height]}
                                 << (kCellBits * (height + 2)); // a brick: 2 levels
    }
    requireIndexable(inner_count + bins.leaf_count, bricks.voxelize.form.attributes ? bins.voxel_count : 0);
    octree.node_count = inner_count + bins.leaf_count;
    octree.voxel_count = bins.voxel_count;
    if (octree.node_count == 0)
    {
        return;
    }
    std::uint32_t first_node = 0;
    bricks.work.item_counts.clear();
    for (std::size_t height = counts.listed.size(); height-- > 0;)
    {
        const std::uint32_t listed = counts.listed[height].count;
        const std::uint32_t count = listed + counts.nodes.full_nodes[height];
        bricks.work.item_counts.push_back(listed);
        octree.levels.push_back({first_node, count});
        first_node += count;
    }
    octree.levels.push_back({first_node, bins.leaf_count});
    octree.nodes = {device, "octree/nodes", octree.node_count};
}

void numberBricks(vk::FrameGraph& graph, OctreeBricks& bricks, DeviceTree& octree)
{
    vk::Device& device = graph.device();
    const std::uint32_t leaf_count = octree.levels.back().node_count;
    LeafBuffers& leaves = bricks.leaves;
    if (bricks.voxelize.form.mixed && leaves.mixed.count() == 0)
    {
        device.memory().require(leaf_count * sizeof(gpu::MixedVoxels), "the leaves of bricks");
        leaves.mixed = {device, "voxelize/mixed_voxels", leaf_count};
    }
    if (bricks.voxelize.fill_planes != 0 && leaves.occupied.count() == 0)
    {
        const std::uint32_t brick_count = octree.levels[octree.levels.size() - 2].node_count;
        device.memory().require(leaf_count * sizeof(gpu::uvec2) + brick_count * sizeof(gpu::uint),
                                "the leaves of bricks");
        bricks.work.order = {device, "octree/brick_order", brick_count};
        bricks.work.brick_partials = {device, "octree/brick_partials", divideUp(brick_count, gpu::kScanBlock)};
        leaves.occupied = {device, "octree/occupied", leaf_count};
    }
    numberNodes(graph, bricks.voxelize, bricks.work, leaves, octree);
}

void averageOctree(vk::FrameGraph& graph, const GpuScene& color_tables, bool filled, DeviceTree& octree)
{
    if (octree.node_attributes.count() == 0)
    {
        octree.node_attributes = {graph.device(), "octree/node_attributes", octree.node_count};
    }
    averageNodes(graph, color_tables, octree);
    if (filled)
    {
        inheritColors(graph, octree);
    }
}

void addLeafWords(vk::FrameGraph& graph, const vk::BufferOf<gpu::uvec2>& occupied, DeviceTree& octree,
                  vk::BufferOf<gpu::Node>& pool)
{
    vk::Device& device = graph.device();
    const std::uint32_t leaf_words = leafWordsOf(octree.levels);
    if (leaf_words == 0)
    {
        return;
    }
    if (pool.count() == 0)
    {
        const std::uint64_t inner_count = octree.node_count - leaf_words;
        const std::uint64_t group_count =
            gpu::kFirstLeafGroup + divideUp(2 * inner_count + leaf_words, gpu::kLeafGroup);
        const std::uint64_t pool_nodes = poolNodes(inner_count, leaf_words, occupied.count() != 0);
        device.memory().require(pool_nodes * sizeof(gpu::Node) + group_count * sizeof(gpu::uvec2), "the leaves");
        octree.leaf_groups = {device, "octree/leaf_groups", group_count};
        pool = {device, octree.nodes.name(), pool_nodes};
    }
    makeLeafWords(graph, octree, occupied, pool, octree.leaf_groups);
}

void takePool(vk::BufferOf<gpu::Node> pool, bool filled, DeviceTree& octree)
{
    if (pool.count() != 0)
    {
        octree.nodes = std::move(pool);
        octree.leaf_words = octree.levels.back().node_count;
        octree.filled = filled;
    }
}

} // namespace zvo
