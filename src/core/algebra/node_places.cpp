// SPDX-License-Identifier: MIT
#include "core/algebra/node_places.h"

#include "algebra/algebra.h"
#include "zvo/error.h"

namespace zvo
{

void placeNodes(vk::FrameGraph& graph, const DeviceTree& octree, std::size_t level_count,
                vk::BufferOf<gpu::uvec2>& places)
{
    graph.fill(places, 0, 0, 2); // the root's
    for (std::size_t level = 0; level + 1 < level_count; ++level)
    {
        const auto [first_node, node_count] = octree.levels[level];
        vk::Pass pass = graph.addPass(gpu::algebra::Places{});
        pass.dispatch(node_count, {.nodes = pass.read(octree.nodes),
                                   .leaf_groups = pass.read(octree.leaf_groups),
                                   .places = pass.readWrite(places),
                                   .first_node = first_node,
                                   .node_count = node_count});
    }
}

std::uint32_t nodesOf(const DeviceTree& octree, std::size_t level_count)
{
    return octree.levels.empty()
               ? 0
               : octree.levels[level_count - 1].first_node + octree.levels[level_count - 1].node_count;
}

void requireOperand(const DeviceTree& tree)
{
    if (tree.grid.nodeLevels() < 2)
    {
        throw Error(ErrorCode::Usage, "algebra takes trees with a resolution of 8 or more");
    }
    if (tree.isDag() || tree.hasOverlays() || isPacked(tree.attributeFormat()))
    {
        throw Error(ErrorCode::Usage, "algebra takes octrees with attributes of 8 bytes, or none");
    }
}

} // namespace zvo
