// SPDX-License-Identifier: MIT
#include "core/trace_ranks.h"

namespace zvo
{

namespace
{

// Records the pass, unless there is no list: then the number in the leaf is the rank.
template <typename Dispatch>
void addRanks(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, bool tiles,
              const Dispatch& dispatch)
{
    const std::uint32_t levels = dag.tree.grid.nodeLevels();
    if (levels < 2)
    {
        return;
    }
    vk::Pass pass =
        graph.addPass("trace/ranks", {levels, options.hasDetail() ? 1U : 0U, tiles ? 1U : 0U, dag.entries_per_word});
    gpu::RanksParams params{};
    params.source = rankSource(pass, dag);
    dispatch(pass, params);
}

} // namespace

bool hasRankTable(const Svdag& dag, const BeamGrid& beam)
{
    return dag.tree.grid.nodeLevels() > gpu::kPathLevels && beam.paths.count() > gpu::kRankTableFirst;
}

gpu::RankSource rankSource(vk::Pass& pass, const Svdag& dag)
{
    const std::uint64_t first_place = dag.packing().firstPlace();
    gpu::RankSource source{};
    source.pool = pass.read(dag.tree.nodes);
    source.before = {pass.read(dag.before).address - first_place * sizeof(gpu::BeforeChild)};
    source.voxels_before_leaf = pass.read(dag.voxels_before_leaf);
    source.first_short_place = static_cast<gpu::uint>(first_place + dag.long_entry_count);
    return source;
}

void buildRankTable(vk::FrameGraph& graph, const Svdag& dag, BeamGrid& beam)
{
    if (!hasRankTable(dag, beam))
    {
        return;
    }
    const bool leaves = dag.tree.grid.nodeLevels() == gpu::kPathLevels + 1;
    vk::Pass pass = graph.addPass("trace/beam_ranks", {leaves ? 1U : 0U, dag.entries_per_word});
    const gpu::BeamRanksParams params = {rankSource(pass, dag), pass.readWrite(beam.paths)};
    pass.dispatch(gpu::kRankTableFirst, params);
}

void rankTiles(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, TraceBuffers& buffers)
{
    addRanks(graph, dag, options, true,
             [&](vk::Pass& pass, gpu::RanksParams& params)
             {
                 params.live = pass.read(buffers.live);
                 params.hits = pass.readWrite(buffers.hits);
                 params.width = buffers.width;
                 params.height = buffers.height;
                 pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
             });
}

void rankHits(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, vk::BufferOf<gpu::Hit>& hits,
              std::uint64_t count)
{
    addRanks(graph, dag, options, false,
             [&](vk::Pass& pass, gpu::RanksParams& params)
             {
                 params.hits = pass.readWrite(hits);
                 params.width = static_cast<gpu::uint>(count);
                 pass.dispatch(count, params);
             });
}

} // namespace zvo
