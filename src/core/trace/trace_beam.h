// SPDX-License-Identifier: MIT
// The beam, by which primary rays skip empty space.
#pragma once

#include "core/trace/trace.h"

namespace zvo
{

/// Records the passes that find where the rays of each tile start: they fill buffers.starts, live and args, and clear
/// status. Cost: tiles x nodes that a beam meets.
void traceBeam(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
               TraceBuffers& buffers);

} // namespace zvo
