// SPDX-License-Identifier: MIT
#include "core/headless/tile_nodes.h"

#include "core/octree/octree_build.h"
#include "core/tree/device_tree.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace zvo
{

namespace
{

// The nodes above tiles as an octree whose voxels are the tiles.
DeviceTree topOctree(vk::HeadlessDevice& device, const Grid& grid, std::size_t top_levels, const TileNodes& tiles)
{
    std::vector<std::vector<gpu::Node>> levels; // the lowest first
    std::vector<std::uint64_t> codes = tiles.codes;
    for (std::size_t level = 0; level < top_levels; ++level)
    {
        std::vector<gpu::Node> nodes;
        std::vector<std::uint64_t> parents;
        for (std::size_t i = 0; i < codes.size(); ++i)
        {
            if (parents.empty() || parents.back() != codes[i] >> kCellBits)
            {
                parents.push_back(codes[i] >> kCellBits);
                nodes.push_back({0, static_cast<std::uint32_t>(i), 0, 0});
            }
            const std::uint64_t cell = codes[i] & ((1U << kCellBits) - 1);
            (cell < 32 ? nodes.back().mask_lo : nodes.back().mask_hi) |= 1U << (cell & 31);
        }
        levels.push_back(std::move(nodes));
        codes = std::move(parents);
    }
    std::ranges::reverse(levels);
    DeviceTree top;
    top.grid = grid;
    std::vector<gpu::Node> all;
    for (std::size_t level = 0; level < top_levels; ++level)
    {
        const std::size_t first_node = all.size();
        const bool is_lowest = level + 1 == top_levels;
        top.levels.push_back(
            {static_cast<std::uint32_t>(first_node), static_cast<std::uint32_t>(levels[level].size())});
        const auto first_child = static_cast<std::uint32_t>(is_lowest ? 0 : first_node + levels[level].size());
        for (gpu::Node node : levels[level])
        {
            node.base_lo += first_child;
            node.base_hi = node.base_lo + static_cast<std::uint32_t>(std::popcount(node.mask_lo));
            all.push_back(node);
        }
    }
    top.node_count = static_cast<std::uint32_t>(all.size());
    top.voxel_count = static_cast<std::uint32_t>(tiles.codes.size());
    top.nodes = device.makeBuffer("octree/nodes", std::span<const gpu::Node>(all));
    top.voxel_attributes = device.makeBuffer("octree/voxel_attributes", std::span(tiles.roots));
    top.node_attributes = {device.device(), "octree/node_attributes", top.node_count};
    return top;
}

} // namespace

std::vector<gpu::Attribute> joinNodes(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid,
                                      std::size_t top_levels, const TileNodes& tiles)
{
    DeviceTree top = topOctree(device, grid, top_levels, tiles);
    device.run([&](vk::FrameGraph& graph) { averageNodes(graph, scene, top); });
    const std::vector<gpu::Attribute> averages = device.download(top.node_attributes);
    std::size_t count = averages.size();
    for (const std::vector<gpu::Attribute>& attributes : tiles.attributes)
    {
        count += attributes.size();
    }
    std::vector<gpu::Attribute> joined;
    joined.reserve(count);
    std::vector<std::uint32_t> next(top_levels); // node of each level that comes next
    for (std::size_t level = 0; level < top_levels; ++level)
    {
        next[level] = top.levels[level].first_node;
    }
    for (std::size_t tile = 0; tile < tiles.codes.size(); ++tile)
    {
        // Nodes above that begin with this tile come before it, the highest first.
        for (std::size_t level = 0; level < top_levels; ++level)
        {
            const auto shift = static_cast<std::uint32_t>(kCellBits * (top_levels - level));
            if (tile == 0 || tiles.codes[tile] >> shift != tiles.codes[tile - 1] >> shift)
            {
                joined.push_back(averages[next[level]++]);
            }
        }
        const std::vector<gpu::Attribute>& attributes = tiles.attributes[tile];
        joined.insert(joined.end(), attributes.begin(), attributes.end());
    }
    return joined;
}

} // namespace zvo
