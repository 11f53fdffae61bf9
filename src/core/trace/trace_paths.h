// SPDX-License-Identifier: MIT
// Where rays may begin below the root.
#pragma once

#include "core/trace/trace.h"

namespace zvo
{

/// Whether the nodes stand level by level with nothing behind them, as in a tree that no update has changed.
bool standsByLevels(const DeviceTree& tree);

/// Whether rays begin below the root, by paths (shaders/trace/node_paths.h).
bool usesPaths(const DeviceTree& tree, const TraceOptions& options);

/// Sets the constants of a kernel with trace/traverse_paths.glsl for a tree and options.
template <typename Kernel> Kernel beginningOnPaths(Kernel kernel, const DeviceTree& tree, const TraceOptions& options)
{
    const bool paths = usesPaths(tree, options);
    kernel.paths = paths;
    kernel.paths_relative = paths && !standsByLevels(tree);
    return kernel;
}

} // namespace zvo
