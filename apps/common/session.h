// SPDX-License-Identifier: MIT
// What the commands have in common.
#pragma once

#include "common/scene_options.h"
#include "core/base/grid.h"
#include "core/headless/pipeline.h"
#include "core/scene/scene.h"
#include "io/scene/animated_scene.h"
#include "vk/headless.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace zvo::cli
{

/// How a command makes its device; pipelines are kept below $XDG_CACHE_HOME/zvo, or ~/.cache/zvo.
vk::HeadlessOptions headlessOptions(const DeviceOptions& options);

/// Loads files as one scene and tells what was left out of it. Throws Error{Input}.
Scene loadWithWarnings(std::span<const std::filesystem::path> paths, const LoadOptions& options);

/// What options name: a scene file with all that it names, or other files as one scene. in_motion: whether times were
/// asked for; without, other files stand at rest. Tells what was left out. Throws Error{Input}, and Error{Usage} for
/// options that do not fit the files.
AnimatedScene loadAnimatedSceneWithWarnings(const VoxelOptions& options, bool in_motion);

/// The grid that options or else the animated scene ask for, or the one around bounds, the animated scene's.
Grid placeGrid(const VoxelOptions& options, const AnimatedScene& animated, const Bounds& bounds);

/// Tells of voxels that are not there, and of triangles that were left out because their numbers make no sense;
/// dropped: triangles by reason. Whether there was something to tell.
bool warnOfDropped(std::uint64_t voxel_count, const std::map<std::string, std::uint64_t>& dropped);

/// Tells of triangles of what moves that were left out at a time of the animated scene because their numbers make no
/// sense. Whether there were any.
bool warnOfDroppedTriangles(double seconds, const std::map<std::string, std::uint64_t>& dropped);

/// Tells where an animated scene's rule of merging has no effect because everything is voxelized together.
void warnOfMergeRule(const AnimatedScene& animated);

/// Throws Error{Other} where the validation layers have said something.
void checkValidation(const vk::HeadlessDevice& device);

} // namespace zvo::cli
