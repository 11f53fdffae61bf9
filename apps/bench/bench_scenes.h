// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

#include <filesystem>
#include <vector>

namespace zvo::cli
{

/// The files to measure: those named, or the usual ones. Throws Error{Input} where there are none, or one is missing.
std::vector<std::filesystem::path> benchScenes(const BenchOptions& options);

} // namespace zvo::cli
