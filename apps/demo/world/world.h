// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/tree/tree_data.h"
#include "io/scene/animated_scene.h"
#include "runtime/live_scene.h"
#include "vk/headless.h"
#include "zvo/dynamic_tree.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace zvo::demo
{

/// What becomes of files.
struct WorldOptions
{
    cli::VoxelOptions voxels;               // scenes: the files; none: an empty world
    std::optional<TreeStructure> structure; // of what stands still; not given: an octree, or the file's
    std::uint32_t frames_in_flight = DynamicTreeInfo().frames_in_flight;
};

/// What files hold, before the device has any of it. A .vox file is read when the world is made.
struct WorldInput
{
    std::optional<AnimatedScene> animated;
    std::optional<TreeData> tree;
};

/// What the window shows: files, in device memory.
struct World
{
    std::string name; // of the file; empty: there is none
    Bounds subject;   // what a picture is about
    LiveScene scene;

    /// Reads what options name, as `zvo render` does; tells of what was left out. Needs no device, and may be called on
    /// any thread. Throws what `zvo render` throws: Error{Input} and Error{Usage}.
    static WorldInput read(const WorldOptions& options);

    /// Makes a world of what was read; .vox files are read now. Waits. Throws as read(), and Error{Memory}. Other
    /// worlds stay as they are.
    static std::unique_ptr<World> make(vk::HeadlessDevice& device, const WorldOptions& options, WorldInput input,
                                       const StaticListener& listener = {});

    /// What is shown as an octree, or a DAG, of its own, for a file; a tree that cannot be edited as it is. Waits for
    /// the device. Throws Error{Memory}.
    [[nodiscard]] TreeData copyTree(vk::HeadlessDevice& device) const;

    /// Which of what moves is around a point of the world, as it is shown; nothing where there is none.
    [[nodiscard]] std::optional<std::size_t> objectAt(const glm::dvec3& point) const;

    /// Whether voxels were made of triangles, which another resolution needs.
    [[nodiscard]] bool isVoxelized() const { return !scene.info().fixed.passes.empty(); }
};

} // namespace zvo::demo
