// SPDX-License-Identifier: MIT
#include "runtime/tile_nodes.h"

#include "core/octree/octree_build.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_build.h"

namespace zvo
{

TreeData octreeOfTiles(const Grid& grid, std::uint32_t tile_depth, std::span<const std::uint64_t> codes)
{
    const float tile_size = grid.voxel_size * static_cast<float>(1U << tile_depth);
    return octreeOfVoxels({grid.origin, tile_size, grid.depth - tile_depth}, codes);
}

std::vector<gpu::Attribute> joinNodes(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid,
                                      std::uint32_t tile_depth, const TileNodes& tiles)
{
    TreeData octree = octreeOfTiles(grid, tile_depth, tiles.codes);
    octree.voxel_attributes = tiles.roots;
    DeviceTree top = uploadTree(device, octree);
    top.node_attributes = {device.device(), "octree/node_attributes", top.node_count};
    device.run([&](vk::FrameGraph& graph) { averageNodes(graph, scene, top); });
    const std::vector<gpu::Attribute> averages = device.download(top.node_attributes);
    std::size_t count = averages.size();
    for (const std::vector<gpu::Attribute>& attributes : tiles.attributes)
    {
        count += attributes.size();
    }
    std::vector<gpu::Attribute> joined;
    joined.reserve(count);
    const std::size_t top_levels = top.levels.size();
    std::vector<DeviceTree::Level> next = top.levels; // first_node: the node of the level that comes next
    for (std::size_t tile = 0; tile < tiles.codes.size(); ++tile)
    {
        // Nodes above that begin with this tile come before it, the highest first.
        for (std::size_t level = 0; level < top_levels; ++level)
        {
            const auto shift = static_cast<std::uint32_t>(kCellBits * (top_levels - level));
            if (tile == 0 || tiles.codes[tile] >> shift != tiles.codes[tile - 1] >> shift)
            {
                joined.push_back(averages[next[level].first_node++]);
            }
        }
        const std::vector<gpu::Attribute>& attributes = tiles.attributes[tile];
        joined.insert(joined.end(), attributes.begin(), attributes.end());
    }
    return joined;
}

} // namespace zvo
