// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

namespace zvo::cli
{

/// `zvo-bench denoise`: how close pictures of few samples come to one of very many, with and without denoising, and
/// what they take. Throws Error.
void benchDenoise(const BenchDenoiseOptions& options);

} // namespace zvo::cli
