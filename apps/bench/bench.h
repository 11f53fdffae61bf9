// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo bench`: measures scenes at several resolutions, and prints a table, JSON, or both. Throws Error.
void bench(const BenchOptions& options);

} // namespace zvo::cli
