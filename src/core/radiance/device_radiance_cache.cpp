// SPDX-License-Identifier: MIT
#include "core/radiance/device_radiance_cache.h"

#include "core/base/divide_up.h"
#include "vk/device.h"
#include "zvo/error.h"

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

// While something moves, faces that no ray has hit in so many frames are left out every so many frames.
constexpr std::uint32_t kPurgeFrames = 128;
constexpr std::uint32_t kEvictAge = 256;

// Where a table must not grow, faces leave that no ray has hit for at least so many frames, at most once in so many.
constexpr std::uint32_t kCrowdedAge = 16;

// The samples that means count after a change, and for how many frames.
constexpr std::uint32_t kChangedSamples = 16;
constexpr std::uint32_t kChangedFrames = 32;

// Faces that rays find of a voxel, and bricks around them: most surfaces show one or two.
constexpr std::uint64_t kFacesOfVoxel = 3;
constexpr std::uint64_t kFacesAtLeast = 64;

// Slots for each face and brick that a table has room for.
constexpr double kSlotsOfFace = 1.125;

// A table that may grow does so while it has room for fewer than kEase times its faces and bricks, to kGrowth times
// that: what rays find until the host learns of it has room, too.
constexpr double kEase = 1.125;
constexpr double kGrowth = 1.125;

// The runs of a table with room for so many faces and bricks.
std::uint64_t runsFor(double face_count)
{
    constexpr double kSlotsMax = gpu::kFaceSlotsMax - gpu::kFaceRun;
    const auto slots = static_cast<std::uint64_t>(std::min(face_count * kSlotsOfFace, kSlotsMax));
    return std::max<std::uint64_t>(slots / gpu::kFaceRun + 1, gpu::kFaceRunsMin);
}

// Whether a frame is one of the `count` ones from `since` on.
bool isSince(const std::optional<std::uint32_t>& since, std::uint32_t frame, std::uint32_t count)
{
    return since && frame - *since < count;
}

} // namespace

std::uint64_t DeviceRadianceCache::bytes() const
{
    const auto bytesOf = [](const auto& part) { return part == nullptr ? std::uint64_t{0} : part->bytes(); };
    return m_status.bytes() + m_counters.bytes() + m_lights.bytes() + bytesOf(m_table) + bytesOf(m_left) +
           bytesOf(m_lists);
}

std::uint64_t DeviceRadianceCache::room() const
{
    return m_table == nullptr ? 0 : static_cast<std::uint64_t>(gpu::kFaceRun / kSlotsOfFace * m_table->run_count);
}

gpu::RadianceCacheTable DeviceRadianceCache::cacheTable(const DeviceEnvironment& environment) const
{
    return {.faces = {faces().address()},
            .environment = {environment.buffer().address()},
            .run_count = runCount(),
            .frame_count = m_frame};
}

void DeviceRadianceCache::forget()
{
    beginAnew();
    m_lights.forget();
}

void DeviceRadianceCache::beginAnew()
{
    m_frame = 0;
    m_course = {};
    m_course.age_max = kEvictAge;
    if (m_deletion_queue != nullptr)
    {
        m_deletion_queue->keep(std::move(m_reports));
    }
    m_reports.clear();
}

void DeviceRadianceCache::reserve(const DeviceTree& tree, std::uint32_t width, std::uint32_t height,
                                  const RadianceOptions& options)
{
    const std::uint32_t faces = std::clamp(options.faces, 1U, kRadianceFacesMax);
    if (m_lists == nullptr || m_lists->faces != faces || m_lists->width != width || m_lists->height != height)
    {
        vk::replace(m_deletion_queue, m_lists, std::make_unique<RadianceLists>(m_device, faces, width, height));
        m_has_new_lists = true;
    }
    if (m_table == nullptr)
    {
        const std::uint64_t likely = tree.hasOverlays() ? UINT64_MAX : kFacesAtLeast + kFacesOfVoxel * tree.voxel_count;
        const std::uint64_t room = std::max(m_room_at_first, std::min(m_lists->insertsMax(), likely));
        m_table =
            std::make_unique<RadianceTable>(m_device, runsFor(static_cast<double>(std::min(room, m_room_at_most))));
        beginAnew();
    }
}

// Notes what has changed since the frame before.
void DeviceRadianceCache::follow(const DeviceTree& tree, const DeviceEnvironment& environment)
{
    if (m_frame == 0)
    {
        beginAnew();
    }
    else
    {
        if (m_environment_version != environment.version())
        {
            noteChange();
        }
        if (m_tree_version != tree.version)
        {
            m_course.move_frame = m_frame;
        }
    }
    m_environment_version = environment.version();
    m_tree_version = tree.version;
}

// Records the passes that move faces: into a larger table where they need it, or without those that no ray has hit for
// long, such as those that moving objects have left. Marks of lists that are gone are removed.
void DeviceRadianceCache::makeRoom(vk::FrameGraph& graph, std::uint32_t frame)
{
    const Move move = {frame, !std::exchange(m_has_new_lists, false)};
    if (frame == 0)
    {
        return;
    }
    const std::uint64_t needed =
        m_course.counts.faces + m_course.counts.bricks + m_course.more * (frame + 1 - m_course.counted_frames);
    const bool is_counted = m_course.counted_frames > m_course.table_frame;
    const bool is_short = is_counted && (needed > room() || m_course.refuses);
    const bool has_moved = m_course.move_frame && *m_course.move_frame >= m_course.purge_frame;
    bool is_done = has_moved && frame - m_course.purge_frame >= kPurgeFrames &&
                   moveFaces(graph, move, m_table->run_count, kEvictAge);
    if (is_counted && !is_done)
    {
        const double eased = kEase * static_cast<double>(needed);
        const bool is_narrow = is_short || eased > static_cast<double>(room());
        is_done =
            is_narrow && (grow(graph, move, eased) || (is_short && grow(graph, move, static_cast<double>(needed))));
        m_course.is_crowded = is_narrow && !is_done;
    }
    if (is_short && !is_done && frame - m_course.table_frame >= kCrowdedAge)
    {
        const std::uint32_t age_max = frame - m_course.purge_frame < kPurgeFrames
                                          ? std::max(m_course.age_max / 2, kCrowdedAge)
                                          : std::min(2 * m_course.age_max, kEvictAge);
        is_done = moveFaces(graph, move, m_table->run_count, age_max);
        m_course.age_max = is_done ? age_max : m_course.age_max;
    }
    if (!is_done && !move.keeps_lists)
    {
        recordMove(graph, move, *m_table, gpu::kMarkFrames);
    }
}

// Records the passes that move faces into a larger table, with room for kGrowth times what is needed, if there may be
// one.
bool DeviceRadianceCache::grow(vk::FrameGraph& graph, const Move& move, double needed)
{
    const double larger = kGrowth * std::max(needed, static_cast<double>(room()));
    const std::uint64_t runs = runsFor(std::min(larger, static_cast<double>(m_room_at_most)));
    return runs > m_table->run_count && moveFaces(graph, move, runs, gpu::kMarkFrames);
}

// Records the passes that move faces of at most an age into a table of so many runs, which then takes the place of the
// last one. Returns false, and records nothing, if there is no memory for it and for moving them once more, or if there
// was none lately.
bool DeviceRadianceCache::moveFaces(vk::FrameGraph& graph, const Move& move, std::uint64_t runs, std::uint32_t age_max)
{
    const std::uint32_t failed = m_course.failed_frame.value_or(move.frame);
    if (failed != move.frame && move.frame - failed < kCrowdedAge)
    {
        return false;
    }
    try
    {
        const std::uint64_t more = runs - m_table->run_count;
        m_device.memory().require(2 * more * m_table->bytes() / m_table->run_count + m_table->bytes(),
                                  "light that moves");
        m_left = std::make_unique<RadianceTable>(m_device, runs);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        m_course.failed_frame = move.frame;
        return false;
    }
    graph.fill(m_left->faces, 0);
    graph.fill(m_left->states, 0);
    recordMove(graph, move, *m_left, age_max);
    std::swap(m_table, m_left);
    m_course.table_frame = move.frame;
    m_course.purge_frame = age_max < gpu::kMarkFrames ? move.frame : m_course.purge_frame;
    m_course.refuses = false;
    return true;
}

// Records the pass that moves faces of at most an age from the table to another one, or leaves them where they are.
void DeviceRadianceCache::recordMove(vk::FrameGraph& graph, const Move& move, RadianceTable& to, std::uint32_t age_max)
{
    graph.fill(m_lists->batch.lists, 0);
    vk::Pass pass = graph.addPass(gpu::radiance::Evict{.relists = move.keeps_lists, .in_place = &to == m_table.get()});
    pass.dispatch(m_table->faces.count(), {.faces = pass.readWrite(to.faces),
                                           .states = pass.readWrite(to.states),
                                           .counters = pass.readWrite(m_counters),
                                           .old_faces = pass.read(m_table->faces),
                                           .old_states = pass.read(m_table->states),
                                           .wanted = pass.readWrite(m_lists->wanted),
                                           .lists = pass.readWrite(m_lists->batch.lists),
                                           .run_count = to.run_count,
                                           .old_slots = static_cast<std::uint32_t>(m_table->faces.count()),
                                           .frame = move.frame,
                                           .age_max = age_max});
}

// Records the copy of the frame's counts to the host.
void DeviceRadianceCache::report(vk::FrameGraph& graph, std::uint32_t frame_count)
{
    if (m_free_reports.empty())
    {
        m_free_reports.emplace_back(m_device, "radiance/report", gpu::kCountersOfFrame, vk::MemoryKind::Readback);
    }
    vk::BufferOf<gpu::uint>& counts = m_free_reports.back();
    graph.copy(m_counters, 0, counts, 0, counts.bytes());
    graph.releaseToHost(); // what counts() reads
    m_reports.push_back({m_deletion_queue == nullptr ? 0 : m_deletion_queue->frame(), frame_count, std::move(counts)});
    m_free_reports.pop_back();
}

RadianceCounts DeviceRadianceCache::counts()
{
    const auto isDone = [&](const Report& report)
    { return m_deletion_queue == nullptr || m_deletion_queue->isDone(report.queue_frame); };
    for (; !m_reports.empty() && isDone(m_reports.front()); m_reports.pop_front())
    {
        Report& report = m_reports.front();
        const gpu::uint* const words = report.counts.mappedData();
        const RadianceCounts told = {words[0], words[1], words[2]};
        const std::uint64_t before = m_course.counts.faces + m_course.counts.bricks;
        const std::uint64_t now = told.faces + told.bricks;
        m_course.more = now > before ? divideUp(now - before, report.frame_count - m_course.counted_frames) : 0;
        // What was refused before the faces moved counts no more.
        const bool is_of_table = m_course.counted_frames > m_course.table_frame || m_course.table_frame == 0;
        m_course.refuses = m_course.refuses || (is_of_table && told.refused > m_course.counts.refused);
        m_course.counts = told;
        m_course.counted_frames = report.frame_count;
        m_free_reports.push_back(std::move(report.counts));
    }
    return m_course.counts;
}

void DeviceRadianceCache::update(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                                 const TraceCamera& camera, const TraceBuffers& seen, const RadianceOptions& options)
{
    vk::replace(m_deletion_queue, m_left, {});
    counts();
    reserve(tree, seen.width, seen.height, options);
    environment.prepare(graph);
    m_lights.prepare(graph, tree);
    follow(tree, environment);
    const std::uint32_t frame = std::exchange(m_frame, 0); // should anything below throw
    makeRoom(graph, frame);
    const RadianceFrame work = {.table = *m_table,
                                .counters = m_counters,
                                .lists = *m_lists,
                                .tree = tree,
                                .environment = environment,
                                .lights = m_lights,
                                .status = m_status,
                                .camera = camera,
                                .seen = seen,
                                .seed = options.seed,
                                .number = frame,
                                .moves = isSince(m_course.move_frame, frame, gpu::kMovedFrames),
                                .window = isSince(m_course.change_frame, frame, kChangedFrames)
                                              ? std::min(options.window, kChangedSamples)
                                              : options.window};
    sampleFaces(graph, work);
    report(graph, frame + 1);
    m_frame = frame + 1;
}

} // namespace zvo
