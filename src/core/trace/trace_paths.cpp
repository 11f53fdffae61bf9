// SPDX-License-Identifier: MIT
#include "core/trace/trace_paths.h"

#include "core/trace/trace_passes.h"
#include "core/trace/trace_ranks.h"
#include "trace/node_paths.h"

namespace zvo
{

namespace
{

constexpr std::uint64_t kPathCellCount = std::uint64_t{gpu::kPathCells} * gpu::kPathCells * gpu::kPathCells;

// Whether the children of all nodes that paths (shaders/trace/node_paths.h) name are nodes, not voxels.
bool hasPaths(const DeviceTree& tree)
{
    return tree.grid.nodeLevels() > gpu::kPathLevels;
}

} // namespace

NodePaths::NodePaths(vk::Device& device, bool for_dag)
    : cells(device, "node paths", for_dag ? std::uint64_t{gpu::kRankTableOverlays} + 1 : kPathCellCount)
{
}

bool standsByLevels(const DeviceTree& tree)
{
    if (tree.levels.empty())
    {
        return false;
    }
    const DeviceTree::Level& last = tree.levels.back();
    const bool has_all_nodes = std::uint64_t{last.first_node} + last.node_count == tree.node_count;
    return has_all_nodes && (tree.isDag() || tree.nodes.count() == tree.packing().poolNodes());
}

bool usesPaths(const DeviceTree& tree, const TraceOptions& options)
{
    return options.beam && hasPaths(tree) && !isEmpty(tree) && !options.hasDetail();
}

void buildNodePaths(vk::FrameGraph& graph, const DeviceTree& tree, NodePaths& paths)
{
    if (isEmpty(tree))
    {
        return;
    }
    if (hasPaths(tree))
    {
        vk::Pass pass = graph.addPass(gpu::trace::NodePaths{.entries_per_word = tree.entriesPerWord()});
        const gpu::NodePathsParams params = {pass.read(tree.nodes), pass.write(paths.cells)};
        pass.dispatch(kPathCellCount, params);
    }
    if (tree.isDag() && tree.hasAttributes())
    {
        buildRankTable(graph, tree, paths);
    }
}

} // namespace zvo
