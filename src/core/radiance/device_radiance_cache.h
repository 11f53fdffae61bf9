// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/light/tree_lights.h"
#include "core/radiance/radiance_passes.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "radiance/radiance.h"
#include "vk/deletion_queue.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace zvo
{

/// Keeps the light that arrives at the faces of voxels (shaders/radiance/radiance.h), and brings it up to date by a
/// bounded number of rays a frame. Owns all buffers.
class DeviceRadianceCache
{
public:
    /// deletion_queue: as in TreeTracer.
    explicit DeviceRadianceCache(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr)
        : m_device(device), m_deletion_queue(deletion_queue), m_status(device, "radiance/status", 1),
          m_lights(device, deletion_queue)
    {
    }

    /// Makes a table for as many faces, unless there is a larger one. It is empty, and takes the place of the last one.
    /// Throws Error{Memory}; then nothing changes.
    void reserveFaces(std::uint64_t face_count);

    /// Makes what update() needs for a tree and pictures of a size, with a table of the usual size if there is none.
    /// Throws Error{Memory}; then what was kept stays.
    void reserve(const DeviceTree& tree, std::uint32_t width, std::uint32_t height, const RadianceOptions& options);

    /// Records the passes of a frame: they sample faces that the camera sees, and those that rays of the frame before
    /// have hit. seen: filled by tracePrimary() of the same tree and camera without a level of detail. Light arrives by
    /// one bounce more in each frame. Throws Error{Memory}. Cost: the pixels of seen, and the rays of options.faces.
    void update(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                const TraceCamera& camera, const TraceBuffers& seen, const RadianceOptions& options);

    /// Has means count few samples for some frames: because voxels have changed in another way than by what moves.
    /// Where the environment changes, update() sees that.
    void noteChange() { m_change_frame = m_frame; }

    /// Forgets all light: because the last frame was lost, or kernels may have changed.
    void forget();

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const;

    /// [1] counts of faces.
    [[nodiscard]] const vk::BufferOf<gpu::RadianceCounters>& counters() const { return m_table->counters; }

    /// [slots] the table, in which free slots have a key of 0.
    [[nodiscard]] const vk::BufferOf<gpu::CachedFace>& faces() const { return m_table->faces; }

    /// Where the buffers of the tree of the last update() are.
    [[nodiscard]] const vk::BufferOf<gpu::TreeTable>& treeTable() const { return m_lights.table(); }

    /// Rays that were given up (TraceStatus::capped_rays), since all light was forgotten.
    [[nodiscard]] const vk::BufferOf<gpu::TraceStatus>& status() const { return m_status; }

    /// Frames since all light was forgotten.
    [[nodiscard]] std::uint32_t frameCount() const { return m_frame; }

private:
    void follow(vk::FrameGraph& graph, const DeviceTree& tree, const DeviceEnvironment& environment);
    void evict(vk::FrameGraph& graph, std::uint32_t age_max);

    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    vk::BufferOf<gpu::TraceStatus> m_status; // [1]
    TreeLights m_lights;
    std::unique_ptr<RadianceTable> m_table;
    std::unique_ptr<RadianceLists> m_lists;
    bool m_has_new_lists = false; // since the last update: marks of what the last ones held stand in the table
    std::unique_ptr<RadianceTable> m_other_table; // where faces are moved to; null until some may be
    std::uint32_t m_frame = 0;                    // 0: the table is to be cleared

    std::uint64_t m_tree_version = 0; // of the last frame, like the next
    std::uint64_t m_environment_version = 0;
    std::uint32_t m_evict_frame = 0;             // of the last purge, or of the first movement since then
    std::optional<std::uint32_t> m_move_frame;   // when the tree was another one than in the frame before
    std::optional<std::uint32_t> m_change_frame; // when other things changed
};

} // namespace zvo
