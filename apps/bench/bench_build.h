// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench build`: measures voxelization, octree construction and compression to a DAG. Prints a table, JSON, or
/// both. Throws Error.
void benchBuild(const BenchBuildOptions& options);

} // namespace zvo::cli
