// SPDX-License-Identifier: MIT
#include "core/trace_ranks.h"

namespace zvo
{

namespace
{

bool hasTable(const Svdag& dag, const BeamGrid& beam)
{
    return dag.tree.grid.nodeLevels() > gpu::kPathLevels && beam.ranks.count() != 0;
}

gpu::RankSource sourceOf(vk::Pass& pass, const Svdag& dag)
{
    gpu::RankSource source{};
    source.pool = pass.read(dag.tree.nodes);
    source.before = pass.read(dag.before);
    source.voxels_before_leaf = pass.read(dag.voxels_before_leaf);
    source.first_word = dag.tree.node_count * static_cast<gpu::uint>(sizeof(gpu::Node) / sizeof(gpu::uint));
    source.long_entry_count = static_cast<gpu::uint>(dag.long_entry_count);
    return source;
}

// Opens the pass, unless there is no list: then the number in the leaf is the rank.
template <typename Dispatch>
void addRanks(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, bool tiles, bool table,
              const Dispatch& dispatch)
{
    const std::uint32_t levels = dag.tree.grid.nodeLevels();
    if (levels < 2)
    {
        return;
    }
    vk::Pass pass =
        graph.addPass("trace/ranks", {levels, options.hasDetail() ? 1U : 0U, tiles ? 1U : 0U, table ? 1U : 0U});
    gpu::RanksParams params{};
    params.source = sourceOf(pass, dag);
    dispatch(pass, params);
}

} // namespace

void buildRankTable(vk::FrameGraph& graph, const Svdag& dag, BeamGrid& beam)
{
    if (!hasTable(dag, beam))
    {
        return;
    }
    const bool leaves = dag.tree.grid.nodeLevels() == gpu::kPathLevels + 1;
    vk::Pass pass = graph.addPass("trace/beam_ranks", {leaves ? 1U : 0U});
    const gpu::BeamRanksParams params = {sourceOf(pass, dag), pass.write(beam.ranks)};
    pass.dispatch(beam.ranks.count(), params);
}

void rankTiles(vk::FrameGraph& graph, const Svdag& dag, const BeamGrid& beam, const TraceOptions& options,
               TraceBuffers& buffers)
{
    const bool table = hasTable(dag, beam) && !options.hasDetail();
    addRanks(graph, dag, options, true, table,
             [&](vk::Pass& pass, gpu::RanksParams& params)
             {
                 params.ranks = table ? pass.read(beam.ranks) : gpu::ConstPtr<uint64_t>{};
                 params.live = pass.read(buffers.live);
                 params.hits = pass.readWrite(buffers.hits);
                 params.width = buffers.width;
                 params.height = buffers.height;
                 pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
             });
}

void rankHits(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, vk::BufferOf<gpu::Hit>& hits)
{
    addRanks(graph, dag, options, false, false,
             [&](vk::Pass& pass, gpu::RanksParams& params)
             {
                 params.hits = pass.readWrite(hits);
                 params.width = static_cast<gpu::uint>(hits.count());
                 pass.dispatch(hits.count(), params);
             });
}

} // namespace zvo
