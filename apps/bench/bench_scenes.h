// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"
#include "core/base/grid.h"
#include "io/scene/animated_scene.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace zvo::cli
{

/// The files to measure: the named ones, or the usual ones. Throws Error{Input} if there are none, or one is missing;
/// Error{Usage} for a scene file, unless the command allows them.
std::vector<std::filesystem::path> benchScenes(const BenchOptions& options, bool allows_scene_files = false);

/// Loads a scene file and what it names, beside it or in the folder of --scenes. Throws Error{Input}.
AnimatedScene loadSceneFile(const BenchOptions& options, const std::filesystem::path& path);

/// The grid of an animated scene: in the scene's bounds, or around everything at all times.
Grid gridOf(const AnimatedScene& animated, const Bounds& bounds_over_time, std::uint32_t depth);

/// The scene files with the scenes of the thesis, as far as they are there. They name models that may be missing.
std::vector<std::filesystem::path> thesisScenes();

} // namespace zvo::cli
