// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo bench --edit`: strokes of a brush on scenes at resolutions, by radius, action and number of strokes, as tables,
/// as JSON, or both. Throws Error.
void benchEdit(const BenchOptions& options);

} // namespace zvo::cli
