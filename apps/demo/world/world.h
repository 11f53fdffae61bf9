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

/// How files become a world.
struct WorldOptions
{
    cli::VoxelOptions voxels;               // scenes: the files; none: an empty world
    std::optional<TreeStructure> structure; // of the static part; not given: an octree, or the file's
    std::uint32_t frames_in_flight = DynamicTreeInfo().frames_in_flight;
};

/// The contents of files, before anything is on the device. A .vox file is read only when the world is made.
struct WorldInput
{
    std::optional<AnimatedScene> animated;
    std::optional<TreeData> tree;
};

/// The contents of files in device memory, which the window shows.
struct World
{
    std::string name; // of the file; empty: there is none
    Bounds subject;   // what a picture should show
    LiveScene scene;

    /// Reads what options name, as `zvo render` does, and reports what was left out. Needs no device, and may be called
    /// on any thread. Throws Error{Input} and Error{Usage} as `zvo render`.
    static WorldInput read(const WorldOptions& options);

    /// Makes a world of what was read; .vox files are read now. Waits. Throws as read(), and Error{Memory}. Other
    /// worlds are not affected.
    static std::unique_ptr<World> make(vk::HeadlessDevice& device, const WorldOptions& options, WorldInput input,
                                       const StaticListener& listener = {});

    /// The tree that is shown as an octree, or a DAG, of its own, for a file; a tree that cannot be edited is returned
    /// as it is. Waits for the device. Throws Error{Memory}.
    [[nodiscard]] TreeData copyTree(vk::HeadlessDevice& device) const;

    /// The dynamic object around a point of the world, as it is shown; nothing if there is none.
    [[nodiscard]] std::optional<std::size_t> objectAt(const glm::dvec3& point) const;

    /// Whether the voxels were made of triangles. Only then another resolution can be chosen.
    [[nodiscard]] bool isVoxelized() const { return !scene.info().fixed.passes.empty(); }
};

} // namespace zvo::demo
