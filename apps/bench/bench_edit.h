// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench edit`: measures strokes of a brush on scenes at several resolutions, by radius, action and number of
/// strokes. Prints tables, JSON, or both. Throws Error.
void benchEdit(const BenchEditOptions& options);

} // namespace zvo::cli
