// SPDX-License-Identifier: MIT
// From hits in a DAG to the indices of their attributes.
#pragma once

#include "core/svdag.h"
#include "core/trace.h"

namespace zvo
{

/// Whether beam has a table (shaders/trace/trace.h) from which trace/primary_ranks can sum up ranks in dag.
bool hasRankTable(const Svdag& dag, const BeamGrid& beam);

/// Records the pass that fills this table. dag has attributes. Cost: constant.
void buildRankTable(vk::FrameGraph& graph, const Svdag& dag, BeamGrid& beam);

/// What ranks in dag, which has attributes, are summed up from; pass reads it.
gpu::RankSource rankSource(vk::Pass& pass, const Svdag& dag);

/// Records the pass that turns Hit::index, as a traversal of dag leaves it, into the attribute index of the voxel or
/// node: of all hits in live tiles, or of the first count hits of a list. dag has attributes. Cost: levels of nodes for
/// each hit.
void rankTiles(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, TraceBuffers& buffers);
void rankHits(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, vk::BufferOf<gpu::Hit>& hits,
              std::uint64_t count);

} // namespace zvo
