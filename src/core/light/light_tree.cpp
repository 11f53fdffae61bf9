// SPDX-License-Identifier: MIT
#include "core/light/light_tree.h"

#include "core/base/divide_up.h"
#include "core/tree/tree_table.h"
#include "vk/device.h"

#include <algorithm>
#include <array>

namespace zvo
{

namespace
{

// The most nodes that a level can have, one for each emissive voxel.
std::uint64_t levelCapacity(const DeviceTree& tree, std::uint32_t level)
{
    const std::uint64_t positions = level >= 10 ? UINT64_MAX : std::uint64_t{1} << (6 * level);
    return std::min<std::uint64_t>(tree.emission.count(), positions);
}

std::uint64_t nodeCapacity(const DeviceTree& tree)
{
    std::uint64_t capacity = 0;
    for (std::uint32_t level = 0; level < tree.grid.nodeLevels(); ++level)
    {
        capacity += levelCapacity(tree, level);
    }
    return capacity;
}

std::uint64_t brickCapacity(const DeviceTree& tree)
{
    return levelCapacity(tree, tree.grid.nodeLevels() - 1);
}

} // namespace

bool hasEmission(const DeviceTree& tree)
{
    return tree.node_count != 0 && tree.hasAttributes() && tree.emission.count() != 0;
}

LightTree::LightTree(vk::Device& device, const DeviceTree& tree)
    : node_capacity(nodeCapacity(tree)), levels(device, "light/levels", gpu::kNodeLevelsMax),
      args(device, "light/args", gpu::kNodeLevelsMax)
{
    const std::uint64_t brick_capacity = brickCapacity(tree);
    device.memory().require(node_capacity * (sizeof(gpu::LightNode) + sizeof(gpu::LightItem)) +
                                brick_capacity * sizeof(gpu::LightBrick),
                            "the light tree");
    nodes = {device, "light/nodes", node_capacity};
    bricks = {device, "light/bricks", brick_capacity};
    items = {device, "light/items", node_capacity};
}

bool LightTree::suffices(const DeviceTree& tree) const
{
    return node_capacity >= nodeCapacity(tree) && bricks.count() >= brickCapacity(tree);
}

void buildLightTree(vk::FrameGraph& graph, const DeviceTree& tree, const vk::BufferOf<gpu::TreeTable>& table,
                    LightTree& lights)
{
    const std::uint32_t level_count = tree.grid.nodeLevels();
    const std::uint32_t entries_per_word = tree.entriesPerWord();
    graph.update(lights.levels, 0, std::array{gpu::LightLevel{0, 1}});
    graph.update(lights.items, 0, std::array{gpu::LightItem{}});
    graph.update(lights.args, 0, std::array{gpu::DispatchArgs{1, 1, 1}});
    for (std::uint32_t level = 0; level + 1 < level_count; ++level)
    {
        const std::uint64_t max_groups = levelCapacity(tree, level);
        {
            const bool has_flags = tree.attributeFormat() == AttributeFormat::Bytes8 && tree.hasNodeAttributes();
            vk::Pass pass = graph.addPass(gpu::light::Expand{
                .node_levels = level_count, .entries_per_word = entries_per_word, .flags = has_flags});
            const gpu::LightExpandParams params = {readTree(pass, tree, table), pass.read(lights.items),
                                                   pass.read(lights.levels), pass.readWrite(lights.nodes), level};
            pass.dispatchIndirect(lights.args, level, params, max_groups);
        }
        {
            vk::Pass pass = graph.addPass(gpu::light::Scan{});
            const gpu::LightScanParams params = {pass.readWrite(lights.nodes),
                                                 pass.readWrite(lights.levels),
                                                 pass.readWrite(lights.args),
                                                 level,
                                                 static_cast<std::uint32_t>(lights.node_capacity),
                                                 graph.device().limits().maxComputeWorkGroupCount[0]};
            pass.dispatch(1, params);
        }
        vk::Pass pass =
            graph.addPass(gpu::light::Children{.node_levels = level_count, .entries_per_word = entries_per_word});
        const gpu::LightChildrenParams params = {readTree(pass, tree, table), pass.readWrite(lights.items),
                                                 pass.read(lights.levels), pass.read(lights.nodes), level};
        pass.dispatchIndirect(lights.args, level, params, max_groups);
    }
    {
        vk::Pass pass =
            graph.addPass(gpu::light::Bricks{.node_levels = level_count, .entries_per_word = entries_per_word});
        const gpu::LightBricksParams params = {readTree(pass, tree, table), pass.readWrite(lights.items),
                                               pass.read(lights.levels),    pass.readWrite(lights.nodes),
                                               pass.write(lights.bricks),   level_count - 1};
        pass.dispatchIndirect(lights.args, level_count - 1, params, lights.bricks.count());
    }
    for (std::uint32_t level = level_count - 1; level-- > 0;)
    {
        vk::Pass pass = graph.addPass(gpu::light::Reduce{});
        const gpu::LightReduceParams params = {pass.readWrite(lights.items), pass.readWrite(lights.nodes),
                                               pass.read(lights.levels), level};
        pass.dispatchIndirect(lights.args, level, params, levelCapacity(tree, level));
    }
}

} // namespace zvo
