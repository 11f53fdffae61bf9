// SPDX-License-Identifier: MIT
// The beam grid, with which primary rays skip empty space.
#pragma once

#include "core/trace/trace.h"

namespace zvo
{

/// Whether the children of all nodes that paths (shaders/trace/beam.h) name are nodes, not voxels.
bool hasPaths(const DeviceTree& tree);

/// Records the passes that find where the rays of each tile start: they fill buffers.starts, live and args, and clear
/// status. Cost: tiles.
void traceBeam(vk::FrameGraph& graph, const DeviceTree& tree, const BeamGrid& beam, const TraceCamera& camera,
               const TraceOptions& options, TraceBuffers& buffers);

} // namespace zvo
