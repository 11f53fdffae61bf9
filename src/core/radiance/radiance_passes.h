// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/light/tree_lights.h"
#include "core/path/path_batch.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "radiance/radiance.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <optional>

namespace zvo
{

/// Options of the radiance cache.
struct RadianceOptions
{
    std::uint32_t faces = 1U << 14;               // the most that a frame takes, by up to two rays and two shadow rays
    std::uint32_t window = gpu::kCachedWeightMax; // the most samples that a mean counts
    std::uint32_t seed = 0;

    bool operator==(const RadianceOptions&) const = default;
};

/// The most faces that RadianceOptions::faces asks for.
inline constexpr std::uint32_t kRadianceFacesMax = 1U << 22;

/// What is kept from frame to frame.
struct RadianceTable
{
    RadianceTable(vk::Device& device, std::uint64_t runs);
    [[nodiscard]] std::uint64_t bytes() const { return faces.bytes() + states.bytes(); }

    std::uint32_t run_count;
    vk::BufferOf<gpu::CachedFace> faces; // [kFaceRun * run_count]
    vk::BufferOf<gpu::FaceState> states; // likewise
};

/// What frames use in turns.
struct RadianceLists
{
    RadianceLists(vk::Device& device, std::uint32_t face_count, std::uint32_t picture_width,
                  std::uint32_t picture_height);
    [[nodiscard]] std::uint64_t bytes() const;

    /// Faces and bricks that a frame may put into the table.
    [[nodiscard]] std::uint64_t insertsMax() const { return wanted.count() + gpu::kBrickLevels * batch.capacity(); }

    std::uint32_t faces;
    std::uint32_t width;
    std::uint32_t height;
    vk::BufferOf<gpu::uint> wanted; // slots: for all rays and pixels that list one
    PathBatch batch;
};

/// What a frame that samples faces is made of.
struct RadianceFrame
{
    RadianceTable& table;
    vk::BufferOf<gpu::RadianceCounters>& counters; // [1]
    RadianceLists& lists;
    const DeviceTree& tree;
    const DeviceEnvironment& environment; // prepared, like lights
    const TreeLights& lights;
    vk::BufferOf<gpu::TraceStatus>& status; // [1] of the rays
    const TraceCamera& camera;
    const TraceBuffers& seen; // filled by tracePrimary() of the same tree and camera without a level of detail
    std::uint32_t seed;
    std::uint32_t number; // 0: nothing is cached yet
    bool moves;           // something has moved lately
    std::uint32_t window; // the most samples that means count

    /// The index of attributes from which on voxels are those of overlays, if there may be any.
    [[nodiscard]] std::optional<std::uint32_t> firstMoving() const
    {
        return tree.hasOverlays() ? std::optional(tree.voxel_count) : std::nullopt;
    }
};

/// Records the passes of a frame (shaders/radiance/radiance.h). Throws Error{Memory}.
void sampleFaces(vk::FrameGraph& graph, const RadianceFrame& frame);

} // namespace zvo
