// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo bench --dynamic`: updates while something moves, beside building everything anew. Throws Error.
void benchDynamic(const BenchOptions& options);

} // namespace zvo::cli
