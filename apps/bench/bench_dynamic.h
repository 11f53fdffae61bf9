// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench dynamic`: measures updates of dynamic objects, and full rebuilds to compare. Throws Error.
void benchDynamic(const BenchDynamicOptions& options);

} // namespace zvo::cli
