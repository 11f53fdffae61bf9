// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"

#include <filesystem>
#include <vector>

namespace zvo::cli
{

/// The files to measure: the named ones, or the usual ones. Throws Error{Input} if there are none, or one is missing;
/// Error{Usage} for a scene file, unless baselines are measured.
std::vector<std::filesystem::path> benchScenes(const BenchOptions& options);

/// The scene files with the scenes of the thesis, as far as they are there. They name models that may be missing.
std::vector<std::filesystem::path> thesisScenes();

} // namespace zvo::cli
