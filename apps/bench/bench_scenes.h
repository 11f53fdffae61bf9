// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

#include <filesystem>
#include <vector>

namespace zvo::cli
{

/// The files to measure: the named ones, or the usual ones. Throws Error{Input} if there are none, or one is missing.
std::vector<std::filesystem::path> benchScenes(const BenchOptions& options);

} // namespace zvo::cli
