// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench tune`: measures every choice that zvo makes by device (core/base/tuning.h) in each of its values, and
/// prints those that are faster than the table's, as --tuning takes them. Throws Error.
void benchTune(const BenchTuneOptions& options);

} // namespace zvo::cli
