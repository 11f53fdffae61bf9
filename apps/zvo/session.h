// SPDX-License-Identifier: MIT
// What the commands have in common.
#pragma once

#include "core/grid.h"
#include "core/pipeline.h"
#include "core/scene.h"
#include "options.h"
#include "vk/headless.h"

#include <filesystem>
#include <span>

namespace zvo::cli
{

/// How a command makes its device; pipelines are kept below $XDG_CACHE_HOME/zvo, or ~/.cache/zvo.
vk::HeadlessOptions headlessOptions(const DeviceOptions& options);

/// Loads files as one scene and tells what was left out of it. Throws Error{Input}.
Scene loadWithWarnings(std::span<const std::filesystem::path> paths, const LoadOptions& options);

/// The grid that options ask for, or the one around bounds.
Grid placeGrid(const VoxelOptions& options, const Bounds& bounds);

/// Tells of triangles that were left out because their numbers make no sense.
void warnOfDropped(const BuildResult& result);

/// Throws Error{Other} where the validation layers have said something.
void checkValidation(const vk::HeadlessDevice& device);

} // namespace zvo::cli
