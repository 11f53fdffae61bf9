// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench cache`: how close pictures by the radiance cache come to path tracing, and what they take,
/// beside paths and primary rays. Throws Error.
void benchCache(const BenchCacheOptions& options);

} // namespace zvo::cli
