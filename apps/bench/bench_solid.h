// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench solid`: measures filled octrees beside those of surfaces, algebra of both, and distances. Prints a table,
/// JSON, or both. Throws Error.
void benchSolid(const BenchSolidOptions& options);

} // namespace zvo::cli
