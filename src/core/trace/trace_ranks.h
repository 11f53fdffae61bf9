// SPDX-License-Identifier: MIT
// From hits in a DAG to the indices of their attributes. In every function tree is a DAG with attributes, which may
// have overlays.
#pragma once

#include "core/trace/trace.h"
#include "core/tree/device_tree.h"

namespace zvo
{

/// Whether paths has a table (shaders/trace/node_paths.h) from which trace/primary_ranks can sum up ranks in tree.
bool hasRankTable(const DeviceTree& tree, const NodePaths& paths);

/// Records the pass that fills this table, if paths has one. Cost: constant.
void buildRankTable(vk::FrameGraph& graph, const DeviceTree& tree, NodePaths& paths);

/// Record the pass that turns Hit::index, as a traversal of tree leaves it, into the index of the voxel's or node's
/// attributes. rankTiles() does it for the hits of all live tiles, rankHits() for the first count hits of a list. Cost:
/// levels of nodes for each hit.
void rankTiles(vk::FrameGraph& graph, const DeviceTree& tree, const TraceOptions& options, TraceBuffers& buffers);
void rankHits(vk::FrameGraph& graph, const DeviceTree& tree, const TraceOptions& options, vk::BufferOf<gpu::Hit>& hits,
              std::uint64_t count, const RayListLength* length);

} // namespace zvo
