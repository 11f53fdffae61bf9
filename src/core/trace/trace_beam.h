// SPDX-License-Identifier: MIT
// The beam grid, with which primary rays skip empty space.
#pragma once

#include "core/trace/trace.h"

namespace zvo
{

/// Whether the nodes stand level by level with nothing behind them, as in a tree that no update has changed.
bool standsByLevels(const DeviceTree& tree);

/// Whether rays begin below the root, by paths (shaders/trace/beam.h).
bool usesPaths(const DeviceTree& tree, const TraceOptions& options);

/// Sets the constants of a kernel with trace/path_loads.glsl for a tree and options.
template <typename Kernel> Kernel beginningOnPaths(Kernel kernel, const DeviceTree& tree, const TraceOptions& options)
{
    const bool paths = usesPaths(tree, options);
    kernel.paths = paths;
    kernel.paths_relative = paths && !standsByLevels(tree);
    return kernel;
}

/// Records the passes that find where the rays of each tile start: they fill buffers.starts, live and args, and clear
/// status. Cost: tiles.
void traceBeam(vk::FrameGraph& graph, const DeviceTree& tree, const BeamGrid& beam, const TraceCamera& camera,
               const TraceOptions& options, TraceBuffers& buffers);

} // namespace zvo
