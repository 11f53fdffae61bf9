// SPDX-License-Identifier: MIT
// Functions that several commands share.
#pragma once

#include "common/progress.h"
#include "common/report.h"
#include "common/scene_options.h"
#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "core/upload/gpu_scene.h"
#include "io/scene/animated_scene.h"
#include "runtime/trees.h"
#include "vk/headless.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace zvo::cli
{

/// zvo's folder in the user's folder that an environment variable names or, if it names no absolute path, in that one
/// of the home folder; empty where there is none.
std::filesystem::path userFolder(const char* variable, const char* in_home);

/// The options with which a command makes its device. Pipelines are kept below $XDG_CACHE_HOME/zvo, or ~/.cache/zvo;
/// messages go to the file that $ZVO_LOG names, if any.
vk::HeadlessOptions headlessOptions(const DeviceOptions& options);

/// A device for a command, with zvo's kernels. While KeptDevices exist, it is that of an earlier command with the same
/// options, if there was one, whose peak of memory begins anew; $ZVO_LOG and the cache's folder are those that it was
/// made with. Throws Error{Device}.
std::shared_ptr<vk::HeadlessDevice> openDevice(const DeviceOptions& options);

/// While one exists, devices outlive their commands: so a process that runs many commands, such as tests, makes kernels
/// once. One at a time.
class KeptDevices
{
public:
    KeptDevices();
    ~KeptDevices();
    KeptDevices(const KeptDevices&) = delete;
    KeptDevices& operator=(const KeptDevices&) = delete;
};

/// Loads files as one scene and reports what was left out of it. Throws Error{Input}.
Scene loadWithWarnings(std::span<const std::filesystem::path> paths, const LoadOptions& options);

/// Loads what options name: a scene file with everything that it names, or other files as one scene. in_motion: whether
/// times were asked for; if not, other files stand at rest. decoding: of their images. Reports what was left out.
/// Throws Error{Input}, and Error{Usage} for options that do not fit the files.
AnimatedScene loadAnimatedSceneWithWarnings(const VoxelOptions& options, bool in_motion,
                                            ImageDecoding decoding = ImageDecoding::WhenLoaded);

/// Uploads a scene for its grid, or for any. Shows the progress of decoding images, and reports those that do not
/// decode.
GpuScene uploadWithWarnings(vk::HeadlessDevice& device, const Scene& scene, const VoxelOptions& options,
                            const std::optional<Grid>& grid, Progress& progress);

/// The grid that options or the animated scene ask for, or else the grid around bounds, those of the animated scene.
Grid placeGrid(const VoxelOptions& options, const AnimatedScene& animated, const Bounds& bounds);

/// Reports surfaces that are open, with what was filled all the same and what was left out. Returns whether it did.
/// strict: throws Error{Input} in place of it.
bool warnOfOpenSurfaces(const OpenSurfaces& open, bool strict);

/// Reports if there are no voxels, and why; connected parts without any; and triangles that were left out because their
/// numbers make no sense. dropped: triangles by reason. Returns whether anything was reported. strict: throws
/// Error{Input} in place of it.
bool warnOfDropped(std::uint64_t voxel_count, const std::map<std::string, std::uint64_t>& dropped,
                   const SceneCounts& counts, bool strict);

/// Reports triangles of dynamic objects that were left out at a time of the animated scene because their numbers make
/// no sense. Returns whether there were any.
bool warnOfDroppedTriangles(double seconds, const std::map<std::string, std::uint64_t>& dropped);

/// Reports if an animated scene's merge rule has no effect because everything is voxelized together.
void warnOfMergeRule(const AnimatedScene& animated);

/// Throws Error{Other} if the validation layers have reported anything.
void checkValidation(const vk::HeadlessDevice& device);

} // namespace zvo::cli
