// SPDX-License-Identifier: MIT
// From hits in a DAG to the indices of their attributes.
#pragma once

#include "core/svdag.h"
#include "core/trace.h"

namespace zvo
{

/// Records the pass that fills beam.ranks, from which rankTiles() goes on, where there is such a table and nodes stand
/// below it. dag has attributes. Cost: constant.
void buildRankTable(vk::FrameGraph& graph, const Svdag& dag, BeamGrid& beam);

/// Records the pass that turns Hit::index, as a traversal of dag leaves it, into the attribute index of the voxel or
/// node: of all hits in live tiles, or of a list of them. dag has attributes. Cost: levels of nodes for each hit; with
/// beam.ranks and without levels of detail, those below kPathLevels.
void rankTiles(vk::FrameGraph& graph, const Svdag& dag, const BeamGrid& beam, const TraceOptions& options,
               TraceBuffers& buffers);
void rankHits(vk::FrameGraph& graph, const Svdag& dag, const TraceOptions& options, vk::BufferOf<gpu::Hit>& hits);

} // namespace zvo
