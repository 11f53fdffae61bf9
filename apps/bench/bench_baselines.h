// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench baselines`: measures the algorithms of zvo's sources (src/baseline) beside zvo's own, on scenes at
/// several resolutions. Prints tables, JSON, or both. What a device's memory does not suffice for is left out, with a
/// warning. Throws Error.
void benchBaselines(const BenchBaselinesOptions& options);

} // namespace zvo::cli
