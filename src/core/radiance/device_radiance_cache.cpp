// SPDX-License-Identifier: MIT
#include "core/radiance/device_radiance_cache.h"

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

// While something moves, faces that no ray has hit in so many frames are left out every so many frames.
constexpr std::uint32_t kPurgeFrames = 128;
constexpr std::uint32_t kEvictAge = 256;

// The samples that means count after a change, and for how many frames.
constexpr std::uint32_t kChangedSamples = 16;
constexpr std::uint32_t kChangedFrames = 32;

// Faces that rays find of a voxel, at most: most surfaces show one or two.
constexpr double kFacesOfVoxel = 2.5;

// Slots for a face, so that few are looked at.
constexpr double kSlotsOfFace = 1.5;

std::uint64_t runsFor(double face_count)
{
    const double slots = std::min(face_count * kSlotsOfFace, double{gpu::kFaceSlotsMax - gpu::kFaceRun});
    return static_cast<std::uint64_t>(slots) / gpu::kFaceRun + 1;
}

// Whether a frame is one of the `count` ones from `since` on.
bool isSince(const std::optional<std::uint32_t>& since, std::uint32_t frame, std::uint32_t count)
{
    return since && frame - *since < count;
}

} // namespace

std::uint64_t DeviceRadianceCache::bytes() const
{
    return m_status.bytes() + m_lights.bytes() + (m_table == nullptr ? 0 : m_table->bytes()) +
           (m_other_table == nullptr ? 0 : m_other_table->bytes()) + (m_lists == nullptr ? 0 : m_lists->bytes());
}

void DeviceRadianceCache::reserveFaces(std::uint64_t face_count)
{
    const std::uint64_t runs = runsFor(static_cast<double>(face_count));
    if (m_table == nullptr || m_table->run_count < runs)
    {
        vk::replace(m_deletion_queue, m_table, std::make_unique<RadianceTable>(m_device, runs));
        m_frame = 0;
    }
}

void DeviceRadianceCache::forget()
{
    m_frame = 0;
    m_lights.forget();
}

void DeviceRadianceCache::reserve(const DeviceTree& tree, std::uint32_t width, std::uint32_t height,
                                  const RadianceOptions& options)
{
    if (m_table == nullptr)
    {
        reserveFaces(static_cast<std::uint64_t>(kFacesOfVoxel * tree.voxel_count));
    }
    const std::uint32_t faces = std::clamp(options.faces, 1U, kRadianceFacesMax);
    const bool needs_lists =
        m_lists == nullptr || m_lists->faces != faces || m_lists->width != width || m_lists->height != height;
    if ((m_other_table == nullptr || m_other_table->run_count != m_table->run_count) &&
        (tree.hasOverlays() || (m_frame != 0 && (needs_lists || m_tree_version != tree.version))))
    {
        vk::replace(m_deletion_queue, m_other_table, std::make_unique<RadianceTable>(m_device, m_table->run_count));
    }
    if (needs_lists)
    {
        vk::replace(m_deletion_queue, m_lists, std::make_unique<RadianceLists>(m_device, faces, width, height));
        m_has_new_lists = true;
    }
}

// Notes what has changed since the frame before.
void DeviceRadianceCache::follow(vk::FrameGraph& graph, const DeviceTree& tree, const DeviceEnvironment& environment)
{
    if (m_frame == 0)
    {
        m_move_frame.reset();
        m_change_frame.reset();
        m_evict_frame = 0;
    }
    else
    {
        if (m_environment_version != environment.version())
        {
            noteChange();
        }
        if (m_tree_version != tree.version)
        {
            m_move_frame = m_frame;
        }
    }
    m_environment_version = environment.version();
    m_tree_version = tree.version;
    const bool has_moved = m_move_frame && *m_move_frame >= m_evict_frame;
    if (has_moved && m_frame - m_evict_frame >= kPurgeFrames)
    {
        evict(graph, kEvictAge);
    }
    else if (std::exchange(m_has_new_lists, false) && m_frame != 0)
    {
        evict(graph, gpu::kMarkFrames); // of marks alone
    }
}

// Records the pass that makes the table anew without lists, and without faces which no ray has hit for long, such as
// those that moving objects have left.
void DeviceRadianceCache::evict(vk::FrameGraph& graph, std::uint32_t age_max)
{
    std::swap(m_table, m_other_table);
    evictFaces(graph, *m_other_table, *m_table, *m_lists, m_frame, age_max);
    m_evict_frame = m_frame;
    m_has_new_lists = false;
}

void DeviceRadianceCache::update(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                                 const TraceCamera& camera, const TraceBuffers& seen, const RadianceOptions& options)
{
    reserve(tree, seen.width, seen.height, options);
    environment.prepare(graph);
    m_lights.prepare(graph, tree);
    follow(graph, tree, environment);
    const std::uint32_t frame = std::exchange(m_frame, 0); // should anything below throw
    const RadianceFrame work = {.table = *m_table,
                                .lists = *m_lists,
                                .tree = tree,
                                .environment = environment,
                                .lights = m_lights,
                                .status = m_status,
                                .camera = camera,
                                .seen = seen,
                                .seed = options.seed,
                                .number = frame,
                                .moves = isSince(m_move_frame, frame, gpu::kMovedFrames),
                                .window = isSince(m_change_frame, frame, kChangedFrames)
                                              ? std::min(options.window, kChangedSamples)
                                              : options.window};
    sampleFaces(graph, work);
    m_frame = frame + 1;
}

} // namespace zvo
