// SPDX-License-Identifier: MIT
// Load balance: the time per voxel for triangles of different shapes and sizes.
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench balance`: measures generated scenes, and files if any were named, at several resolutions. Prints times
/// and their ratios as a table, JSON, or both. Throws Error.
void benchBalance(const BenchBalanceOptions& options);

} // namespace zvo::cli
