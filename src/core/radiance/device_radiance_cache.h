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
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace zvo
{

/// Counts of the radiance cache.
struct RadianceCounts
{
    std::uint64_t faces = 0;
    std::uint64_t bricks = 0;
    std::uint64_t refused = 0; // faces that found no slot, each time that a ray has hit them
};

/// Keeps the light that arrives at the faces of voxels (shaders/radiance/radiance.h), and brings it up to date by a
/// bounded number of rays a frame. The table of faces grows with them, into another one; where it may not, or memory
/// does not suffice, those make room that no ray has hit for longest. The counts that decide are those of frames that
/// the device is done with: nothing waits. Owns all buffers.
class DeviceRadianceCache
{
public:
    /// deletion_queue: as in TreeTracer. Without one, the device is done with a frame when the next one is recorded.
    explicit DeviceRadianceCache(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr)
        : m_device(device), m_deletion_queue(deletion_queue), m_status(device, "radiance/status", 1),
          m_counters(device, "radiance/counters", 1), m_lights(device, deletion_queue)
    {
    }

    /// Sets how many faces and bricks there is room for: at first, if that is more than is usual, and at most.
    void setRoom(std::uint64_t at_first, std::uint64_t at_most)
    {
        m_room_at_first = at_first;
        m_room_at_most = at_most;
    }

    /// Makes what update() needs for a tree and pictures of a size: a table for all that the first frame may find, or
    /// that the tree is likely to have, if there is none. Throws Error{Memory}; then what was kept stays.
    void reserve(const DeviceTree& tree, std::uint32_t width, std::uint32_t height, const RadianceOptions& options);

    /// Records the passes of a frame: they sample faces that the camera sees, and those that rays of the frame before
    /// have hit. seen: filled by tracePrimary() of the same tree and camera without a level of detail. Light arrives by
    /// one bounce more in each frame. Throws Error{Memory}. Cost: the pixels of seen, and the rays of options.faces.
    void update(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                const TraceCamera& camera, const TraceBuffers& seen, const RadianceOptions& options);

    /// Has means count few samples for some frames: because voxels have changed in another way than by what moves.
    /// Where the environment changes, update() sees that.
    void noteChange() { m_course.change_frame = m_frame; }

    /// Forgets all light: because the last frame was lost, or kernels may have changed.
    void forget();

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const;

    /// [1] counts of faces.
    [[nodiscard]] const vk::BufferOf<gpu::RadianceCounters>& counters() const { return m_counters; }

    /// The counts of the newest frame that the device is done with.
    RadianceCounts counts();

    /// Faces and bricks that the table has room for.
    [[nodiscard]] std::uint64_t room() const;

    /// Whether the table would be larger if it might, or if memory sufficed.
    [[nodiscard]] bool isCrowded() const { return m_course.is_crowded; }

    /// [slots] the table, in which free slots have a key of 0.
    [[nodiscard]] const vk::BufferOf<gpu::CachedFace>& faces() const { return m_table->faces; }
    [[nodiscard]] std::uint32_t runCount() const { return m_table->run_count; }

    /// Where the buffers of the tree of the last update() are.
    [[nodiscard]] const vk::BufferOf<gpu::TreeTable>& treeTable() const { return m_lights.table(); }

    /// Rays that were given up (TraceStatus::capped_rays), since all light was forgotten.
    [[nodiscard]] const vk::BufferOf<gpu::TraceStatus>& status() const { return m_status; }

    /// What shaders of a host need to know of the light that the last update() has recorded (docs/host-glsl.md). Out of
    /// date with the next one, which may move all faces. Declares no access: as treeTable().
    [[nodiscard]] gpu::RadianceCacheTable cacheTable(const DeviceEnvironment& environment) const;

    /// Frames since all light was forgotten.
    [[nodiscard]] std::uint32_t frameCount() const { return m_frame; }

private:
    // The counts of a frame, in a buffer that the host reads once the device is done with it.
    struct Report
    {
        std::uint64_t queue_frame; // of m_deletion_queue
        std::uint32_t frame_count; // up to it
        vk::BufferOf<gpu::uint> counts;
    };

    // How faces move in a frame.
    struct Move
    {
        std::uint32_t frame;
        bool keeps_lists; // what was listed stays so
    };

    // What has happened since all light was forgotten.
    struct Course
    {
        RadianceCounts counts;
        std::uint32_t counted_frames = 0; // of which counts are
        std::uint64_t more = 0;           // faces and bricks that a frame is likely to add
        bool refuses = false;             // the table, as it is, has refused faces
        bool is_crowded = false;
        std::uint32_t age_max = 0;                 // of the faces that stay when others make room
        std::uint32_t table_frame = 0;             // when faces came into the table, as it is
        std::uint32_t purge_frame = 0;             // when old ones left
        std::optional<std::uint32_t> failed_frame; // when memory did not suffice for another table
        std::optional<std::uint32_t> move_frame;   // when the tree was another one than in the frame before
        std::optional<std::uint32_t> change_frame; // when other things changed
    };

    void beginAnew();
    void follow(const DeviceTree& tree, const DeviceEnvironment& environment);
    void makeRoom(vk::FrameGraph& graph, std::uint32_t frame);
    bool grow(vk::FrameGraph& graph, const Move& move, double needed);
    bool moveFaces(vk::FrameGraph& graph, const Move& move, std::uint64_t runs, std::uint32_t age_max);
    void recordMove(vk::FrameGraph& graph, const Move& move, RadianceTable& to, std::uint32_t age_max);
    void report(vk::FrameGraph& graph, std::uint32_t frame_count);

    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    vk::BufferOf<gpu::TraceStatus> m_status;        // [1]
    vk::BufferOf<gpu::RadianceCounters> m_counters; // [1]
    TreeLights m_lights;
    std::unique_ptr<RadianceTable> m_table;
    std::unique_ptr<RadianceLists> m_lists;
    bool m_has_new_lists = false;          // since the last update: marks of what the last ones held stand in the table
    std::unique_ptr<RadianceTable> m_left; // where faces have come from in the last frame; mostly null
    std::uint32_t m_frame = 0;             // 0: the table is to be cleared
    std::uint64_t m_room_at_first = 0;
    std::uint64_t m_room_at_most = UINT64_MAX;

    std::deque<Report> m_reports; // of frames that the device may not be done with
    std::vector<vk::BufferOf<gpu::uint>> m_free_reports;

    std::uint64_t m_tree_version = 0; // of the last frame, like the next
    std::uint64_t m_environment_version = 0;
    Course m_course;
};

} // namespace zvo
