// SPDX-License-Identifier: MIT
// Balance of load: what a voxel costs, whatever the triangles are like that cover it.
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo bench --balance`: measures generated scenes, and files if any were named, at resolutions, and tells the times
/// and their ratios as a table, as JSON, or both. Throws Error.
void benchBalance(const BenchOptions& options);

} // namespace zvo::cli
