// SPDX-License-Identifier: MIT
// The beam grid, by which primary rays skip what is empty.
#pragma once

#include "core/trace/trace.h"

namespace zvo
{

/// Whether all nodes that paths (shaders/trace/trace.h) name have children which are nodes.
bool hasPaths(const DeviceTree& octree);

/// Records the passes that find out where the rays of each tile start: fills buffers.starts, live and args, and clears
/// status. Cost: tiles.
void traceBeam(vk::FrameGraph& graph, const DeviceTree& octree, const BeamGrid& beam, const TraceCamera& camera,
               const TraceOptions& options, TraceBuffers& buffers);

} // namespace zvo
