// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench queries`: measures lists of questions of each kind to octrees and their DAGs. Prints a table, JSON, or
/// both. Throws Error.
void benchQueries(const BenchQueriesOptions& options);

} // namespace zvo::cli
