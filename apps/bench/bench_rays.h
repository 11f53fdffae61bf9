// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench rays`: measures primary rays through octrees and their DAGs, and through the same voxels and triangles by
/// Embree, where zvo-bench was built with it. Prints a table, JSON, or both. Throws Error.
void benchRays(const BenchRaysOptions& options);

} // namespace zvo::cli
