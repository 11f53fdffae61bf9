// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench kept`: how close pictures of light that is kept on voxels come to path tracing, and what they take,
/// beside paths and primary rays. Throws Error.
void benchKept(const BenchKeptOptions& options);

} // namespace zvo::cli
