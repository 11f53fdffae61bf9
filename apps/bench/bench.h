// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo bench`: measures scenes at resolutions and tells the numbers as a table, as JSON, or both. Throws Error.
void bench(const BenchOptions& options);

} // namespace zvo::cli
