// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench path`: what a ray of a path costs beside a primary ray, and beside Embree's; and the variance of
/// pictures by each way of finding light. Throws Error.
void benchPath(const BenchPathOptions& options);

} // namespace zvo::cli
