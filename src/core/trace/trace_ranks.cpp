// SPDX-License-Identifier: MIT
#include "core/trace/trace_ranks.h"

#include "core/trace/trace_passes.h"
#include "trace/node_paths.h"

namespace zvo
{

namespace
{

// Declares that pass reads the ranks of overlays' nodes, and returns their address; null without overlays.
gpu::ConstPtr<gpu::BeforeChild> overlayRanks(vk::AnyPass& pass, const DeviceTree& tree)
{
    if (!tree.hasOverlays())
    {
        return {};
    }
    return {pass.read(tree.overlays.ranks).address - tree.overlays.ranksSkipped()};
}

// Records the pass, unless there is no list: then the number in the leaf is the rank.
template <typename Dispatch>
void addRanks(vk::FrameGraph& graph, const DeviceTree& tree, const TraceOptions& options, bool tiles, bool counted,
              const Dispatch& dispatch)
{
    const std::uint32_t levels = tree.grid.nodeLevels();
    if (levels < 2)
    {
        return;
    }
    vk::Pass pass = graph.addPass(gpu::trace::Ranks{.node_levels = levels,
                                                    .detail = options.hasDetail(),
                                                    .tiles = tiles,
                                                    .entries_per_word = tree.entriesPerWord(),
                                                    .overlays = tree.hasOverlays(),
                                                    .counted = counted});
    gpu::RanksParams params{};
    params.source = rankSource(pass, tree);
    params.overlay_ranks = overlayRanks(pass, tree);
    params.attribute_offset = tree.hasOverlays() ? tree.attributeOffset() : 0;
    dispatch(pass, params);
}

} // namespace

bool hasRankTable(const DeviceTree& tree, const NodePaths& paths)
{
    return tree.grid.nodeLevels() > gpu::kPathLevels && tree.lists.voxels_before_leaf.count() != 0 &&
           paths.cells.count() > gpu::kRankTableFirst;
}

void buildRankTable(vk::FrameGraph& graph, const DeviceTree& tree, NodePaths& paths)
{
    if (!hasRankTable(tree, paths))
    {
        return;
    }
    const bool leaves = tree.grid.nodeLevels() == gpu::kPathLevels + 1;
    vk::Pass pass = graph.addPass(gpu::trace::NodeRanks{
        .leaves = leaves, .entries_per_word = tree.entriesPerWord(), .overlays = tree.hasOverlays()});
    const gpu::NodeRanksParams params = {rankSource(pass, tree), overlayRanks(pass, tree), pass.readWrite(paths.cells)};
    pass.dispatch(gpu::kRankTableFirst, params);
}

void rankTiles(vk::FrameGraph& graph, const DeviceTree& tree, const TraceOptions& options, TraceBuffers& buffers)
{
    addRanks(graph, tree, options, true, false,
             [&](auto& pass, gpu::RanksParams& params)
             {
                 params.live = pass.read(buffers.live);
                 params.hits = pass.readWrite(buffers.hits);
                 params.width = buffers.width;
                 params.height = buffers.height;
                 pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
             });
}

void rankHits(vk::FrameGraph& graph, const DeviceTree& tree, const TraceOptions& options, vk::BufferOf<gpu::Hit>& hits,
              std::uint64_t count, const RayListLength* length)
{
    addRanks(graph, tree, options, false, length != nullptr,
             [&](auto& pass, gpu::RanksParams& params)
             {
                 params.hits = pass.readWrite(hits);
                 params.hit_count = static_cast<gpu::uint>(count);
                 params.list_length = readLength(pass, length);
                 dispatchList(pass, params, count, length);
             });
}

} // namespace zvo
