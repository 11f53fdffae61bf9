// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/light/tree_lights.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "path/path.h"
#include "vk/frame_graph.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace zvo
{

/// How paths find light. All ways have the same mean; they differ in their variance.
enum class LightSampling : std::uint32_t
{
    Both = gpu::kSampleBoth,     ///< both of the following, weighted by the balance heuristic
    Chance = gpu::kSampleChance, ///< only where rays happen to meet it
    Lights = gpu::kSampleLights, ///< only by shadow rays to chosen lights
};

/// The buffers of paths that advance together (shaders/path/path.h).
struct PathBatch
{
    PathBatch() = default;

    /// For paths in two lists. shares: the shadow rays of one take the place of the other's paths, and lists of what
    /// paths have met that of the lights which they have looked for before. set_count: of lists.
    /// Of no paths, only these are made.
    PathBatch(vk::Device& device, std::uint64_t path_count, bool shares, std::uint32_t set_count);

    /// Bytes that the lists of paths take, without those that tell their lengths.
    static std::uint64_t bytesFor(std::uint64_t path_count, bool shares);

    /// Where the shadow rays of a list of paths are.
    [[nodiscard]] vk::BufferOf<gpu::Ray>& shadowRays(std::size_t paths)
    {
        return shadow_rays.count() == 0 ? rays.at(1 - paths) : shadow_rays;
    }
    [[nodiscard]] gpu::Ptr<gpu::ShadowState> useShadowStates(vk::AnyPass& pass, std::size_t paths)
    {
        return shadow_states.count() == 0 ? gpu::Ptr<gpu::ShadowState>{pass.readWrite(states.at(1 - paths)).address}
                                          : pass.readWrite(shadow_states);
    }

    /// The element of numbers where a list of them begins.
    [[nodiscard]] std::uint64_t firstNumber(std::uint32_t list) const;

    [[nodiscard]] std::uint64_t capacity() const { return radiance.count(); }
    [[nodiscard]] std::uint64_t bytes() const;

    std::array<vk::BufferOf<gpu::Ray>, 2> rays;         // [capacity] of each list of paths
    std::array<vk::BufferOf<gpu::PathState>, 2> states; // [capacity] likewise
    vk::BufferOf<gpu::Hit> hits;                        // [capacity]
    vk::BufferOf<gpu::Ray> shadow_rays;                 // [capacity] unless they are shared, like the next
    vk::BufferOf<gpu::ShadowState> shadow_states;       // [capacity]
    vk::BufferOf<gpu::vec3> radiance;                   // [capacity] by slots
    vk::BufferOf<gpu::uint> numbers;                    // [kListCount][capacity], or [kListMisses] if lists are shared
    vk::BufferOf<gpu::DispatchArgs> rounds;             // [kTraceRoundsMax]
    vk::BufferOf<gpu::DispatchArgs> lists;              // [set_count][kListElements] usually a set for a bounce
};

/// What the light of paths depends on.
struct PathLight
{
    const DeviceTree& tree;
    const DeviceEnvironment& environment; // prepared, like lights
    const TreeLights& lights;
    vk::BufferOf<gpu::TraceStatus>& status;
    LightSampling sampling = LightSampling::Both;
    bool by_power = false; // chooses voxels by their light alone, wherever they are
    bool smooth = false;   // paths have left what the camera sees, by its normal
    std::uint32_t sample_index = 0;
    std::uint64_t path_count = 0; // the most paths that the lists hold
    /// Set: marks paths whose shadow rays have hit a voxel from this index of attributes on, by bit 31 of their numbers
    /// in kListPaths.
    std::optional<std::uint32_t> first_noted = std::nullopt;
};

/// The element of PathBatch::lists with the workgroups for a list of a bounce.
std::uint64_t listArgs(std::uint32_t bounce, std::uint32_t list);

/// The length of a list of a bounce.
RayListLength listLength(const vk::BufferOf<gpu::DispatchArgs>& lists, std::uint32_t bounce, std::uint32_t list);

/// Records the passes that find what the rays of a list of paths (0 or 1) hit.
void tracePaths(vk::FrameGraph& graph, const PathLight& light, PathBatch& batch, std::size_t paths,
                std::uint32_t bounce);

/// Records the passes that add the light which the rays of a list of paths have met: kListMisses and kListEmitters.
void addMetLight(vk::FrameGraph& graph, const PathLight& light, PathBatch& batch, std::size_t paths,
                 std::uint32_t bounce);

/// Records the passes that choose a light for each path of kListMapLights and kListVoxelLights, numbers of a list of
/// paths, and add its light where a shadow ray reaches it.
void addChosenLight(vk::FrameGraph& graph, const PathLight& light, PathBatch& batch, std::size_t paths,
                    std::uint32_t bounce);

/// Declares that pass reads the attributes of voxels, in whatever format they are, and returns where they are.
gpu::ConstPtr<gpu::Attribute> readVoxelAttributes(vk::AnyPass& pass, const DeviceTree& tree);

} // namespace zvo
