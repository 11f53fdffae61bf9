// SPDX-License-Identifier: MIT
#include "core/radiance/radiance_cache.h"

#include "core/base/divide_up.h"
#include "vk/device.h"

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

// While something moves, faces that no ray has hit in so many frames are left out every so many frames.
constexpr std::uint32_t kPurgeFrames = 128;
constexpr std::uint32_t kPurgeAge = 256;

// The samples that means count after a change, and for how many frames.
constexpr std::uint32_t kChangedSamples = 16;
constexpr std::uint32_t kChangedFrames = 32;

// The rays of a path, at most: a second one where the first has hit a face without light.
constexpr std::uint32_t kFaceRays = 2;

constexpr const char* kPurpose = "light on voxels";

// Faces that rays find of a voxel, at most: most surfaces show one or two.
constexpr double kFacesOfVoxel = 2.5;

// Slots for a face, so that few are looked at.
constexpr double kSlotsOfFace = 1.5;

std::uint64_t runsFor(double face_count)
{
    const double slots = std::min(face_count * kSlotsOfFace, double{gpu::kFaceSlotsMax - gpu::kFaceRun});
    return static_cast<std::uint64_t>(slots) / gpu::kFaceRun + 1;
}

// How many pixels of each 2x2 list their face in a frame: the camera lists about as many faces as a frame may take, or
// one for each 2x2 where that is more.
std::uint32_t wantingTurns(std::uint32_t width, std::uint32_t height, std::uint32_t faces)
{
    const std::uint64_t quads = divideUp(width, 2U) * std::uint64_t{divideUp(height, 2U)};
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(faces / std::max<std::uint64_t>(quads, 1), 1, 4));
}

// The pixels that it takes, at most.
std::uint64_t wantingPixels(std::uint32_t width, std::uint32_t height, std::uint32_t faces)
{
    return divideUp(width, 2U) * std::uint64_t{divideUp(height, 2U)} * wantingTurns(width, height, faces);
}

// Whether a frame is one of the `count` ones from `since` on.
bool isSince(const std::optional<std::uint32_t>& since, std::uint32_t frame, std::uint32_t count)
{
    return since && frame - *since < count;
}

// The list of the faces that a frame takes, as a bounce of PathBatch::lists.
std::uint32_t wantedList(std::uint32_t frame)
{
    return gpu::kWantedEven + frame % 2;
}

} // namespace

RadianceCache::Table::Table(vk::Device& device, std::uint64_t runs)
    : run_count(static_cast<std::uint32_t>(runs)), counters(device, "radiance/counters", 1)
{
    const std::uint64_t slots = gpu::kFaceRun * runs;
    device.memory().require(slots * (sizeof(gpu::KeptFace) + sizeof(gpu::FaceState)), kPurpose);
    faces = {device, "radiance/faces", slots};
    states = {device, "radiance/states", slots};
}

std::uint64_t RadianceCache::Table::bytes() const
{
    return faces.bytes() + states.bytes() + counters.bytes();
}

RadianceCache::Frame::Frame(vk::Device& device, std::uint32_t frame_faces, std::uint32_t picture_width,
                            std::uint32_t picture_height)
    : faces(frame_faces), width(picture_width), height(picture_height)
{
    // The camera lists as many faces as pixels want one, and the paths of a frame as many as there are.
    const std::uint64_t wanted_max = kFaceRays * std::uint64_t{faces} + wantingPixels(width, height, faces);
    const std::uint64_t brick_count = gpu::kBrickLevels * std::uint64_t{faces};
    device.memory().require(PathBatch::bytesFor(faces, kFaceRays) + faces * sizeof(gpu::uint) +
                                2 * wanted_max * sizeof(gpu::uint) +
                                brick_count * (sizeof(gpu::uint) + sizeof(gpu::BrickSum)),
                            kPurpose);
    for (vk::BufferOf<gpu::uint>& slots : wanted)
    {
        slots = {device, "radiance/wanted", wanted_max};
    }
    batch = {device, faces, kFaceRays, gpu::kFirstBricks + gpu::kBrickLevels};
    unlit = {device, "radiance/unlit", faces};
    bricks = {device, "radiance/bricks", brick_count};
    sums = {device, "radiance/brick_sums", brick_count};
}

std::uint64_t RadianceCache::Frame::bytes() const
{
    return wanted[0].bytes() + wanted[1].bytes() + batch.bytes() + unlit.bytes() + bricks.bytes() + sums.bytes();
}

std::uint64_t RadianceCache::bytes() const
{
    return m_status.bytes() + m_lights.bytes() + (m_table == nullptr ? 0 : m_table->bytes()) +
           (m_other_table == nullptr ? 0 : m_other_table->bytes()) + (m_buffers == nullptr ? 0 : m_buffers->bytes());
}

void RadianceCache::reserveFaces(std::uint64_t face_count)
{
    const std::uint64_t runs = runsFor(static_cast<double>(face_count));
    if (m_table == nullptr || m_table->run_count < runs)
    {
        vk::replace(m_deletion_queue, m_table, std::make_unique<Table>(m_device, runs));
        m_frame = 0;
    }
}

void RadianceCache::forget()
{
    m_frame = 0;
    m_lights.forget();
}

void RadianceCache::reserve(const DeviceTree& tree, std::uint32_t width, std::uint32_t height,
                            const RadianceOptions& options)
{
    if (m_table == nullptr)
    {
        reserveFaces(static_cast<std::uint64_t>(kFacesOfVoxel * tree.voxel_count));
    }
    const std::uint32_t faces = std::clamp(options.faces, 1U, kRadianceFacesMax);
    const bool needs_lists =
        m_buffers == nullptr || m_buffers->faces != faces || m_buffers->width != width || m_buffers->height != height;
    if ((m_other_table == nullptr || m_other_table->run_count != m_table->run_count) &&
        (tree.hasOverlays() || (m_frame != 0 && (needs_lists || m_tree_version != tree.version))))
    {
        vk::replace(m_deletion_queue, m_other_table, std::make_unique<Table>(m_device, m_table->run_count));
    }
    if (needs_lists)
    {
        vk::replace(m_deletion_queue, m_buffers, std::make_unique<Frame>(m_device, faces, width, height));
        m_has_new_lists = true;
    }
}

// Records what a frame needs cleared.
void RadianceCache::clear(vk::FrameGraph& graph, std::uint32_t frame)
{
    constexpr std::uint64_t kWords = gpu::kListElements * sizeof(gpu::DispatchArgs) / sizeof(gpu::uint);
    PathBatch& batch = m_buffers->batch;
    if (frame == 0)
    {
        graph.fill(m_table->faces, 0);
        graph.fill(m_table->states, 0);
        graph.fill(m_table->counters, 0);
        graph.fill(m_status, 0);
        graph.fill(batch.lists, 0);
        graph.fill(m_buffers->sums, 0);
        return;
    }
    graph.fill(batch.lists, 0, 0, gpu::kWantedEven * kWords);
    graph.fill(batch.lists, 0, wantedList(frame + 1) * kWords, kWords);
    graph.fill(batch.lists, 0, gpu::kFirstBricks * kWords, gpu::kBrickLevels * kWords);
    graph.fill(m_table->counters, 0, gpu::kCountersOfFrame,
               sizeof(gpu::RadianceCounters) / sizeof(gpu::uint) - gpu::kCountersOfFrame);
}

/// What a frame is made of.
struct RadianceCache::Work
{
    const DeviceTree& tree;
    const DeviceEnvironment& environment;
    const TraceCamera& camera;
    const TraceBuffers& seen;
    const RadianceOptions& options;
    std::uint32_t frame;
    bool moves;           // something has moved lately
    std::uint32_t window; // of means

    /// The index of attributes from which on voxels are those of overlays, if there may be any.
    [[nodiscard]] std::optional<std::uint32_t> firstMoving() const
    {
        return tree.hasOverlays() ? std::optional(tree.voxel_count) : std::nullopt;
    }
};

// Notes what has changed since the frame before.
void RadianceCache::follow(vk::FrameGraph& graph, const DeviceTree& tree, const DeviceEnvironment& environment)
{
    if (m_frame == 0)
    {
        m_move_frame.reset();
        m_change_frame.reset();
        m_purge_frame = 0;
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
    const bool has_moved = m_move_frame && *m_move_frame >= m_purge_frame;
    if (has_moved && m_frame - m_purge_frame >= kPurgeFrames)
    {
        purge(graph, kPurgeAge);
    }
    else if (std::exchange(m_has_new_lists, false) && m_frame != 0)
    {
        purge(graph, gpu::kMarkFrames); // of marks alone
    }
}

// Records the pass that makes the table anew without lists, and without faces which no ray has hit for long, such as
// those that moving objects have left.
void RadianceCache::purge(vk::FrameGraph& graph, std::uint32_t age_max)
{
    std::swap(m_table, m_other_table);
    graph.fill(m_table->faces, 0);
    graph.fill(m_table->states, 0);
    graph.fill(m_table->counters, 0);
    graph.fill(m_buffers->batch.lists, 0);
    graph.fill(m_buffers->sums, 0);
    vk::Pass pass = graph.addPass(gpu::radiance::Purge{});
    gpu::RadiancePurgeParams params{};
    params.faces = pass.readWrite(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.counters = pass.readWrite(m_table->counters);
    params.old_faces = pass.read(m_other_table->faces);
    params.old_states = pass.read(m_other_table->states);
    params.run_count = m_table->run_count;
    params.frame = m_frame;
    params.age_max = age_max;
    pass.dispatch(m_table->faces.count(), params);
    m_purge_frame = m_frame;
    m_has_new_lists = false;
}

void RadianceCache::update(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                           const TraceCamera& camera, const TraceBuffers& seen, const RadianceOptions& options)
{
    reserve(tree, seen.width, seen.height, options);
    environment.prepare(graph);
    m_lights.prepare(graph, tree);
    follow(graph, tree, environment);
    const std::uint32_t frame = std::exchange(m_frame, 0); // should anything below throw
    const Work work = {.tree = tree,
                       .environment = environment,
                       .camera = camera,
                       .seen = seen,
                       .options = options,
                       .frame = frame,
                       .moves = isSince(m_move_frame, frame, gpu::kMovedFrames),
                       .window = isSince(m_change_frame, frame, kChangedFrames)
                                     ? std::min(options.window, kChangedSamples)
                                     : options.window};
    clear(graph, work.frame);
    want(graph, work);
    tally(graph, work);
    take(graph, work);
    begin(graph, work);
    for (std::uint32_t level = 2; level <= gpu::kBrickLevels; ++level)
    {
        surround(graph, level);
    }
    for (std::uint32_t ray = 0; ray < kFaceRays; ++ray)
    {
        if (ray != 0)
        {
            extend(graph, work);
        }
        const PathLight light = {.tree = tree,
                                 .environment = environment,
                                 .lights = m_lights,
                                 .status = m_status,
                                 .stack = options.stack,
                                 .sample_index = work.frame,
                                 .path_count = m_buffers->faces,
                                 .first_noted = ray == 0 ? work.firstMoving() : std::nullopt};
        addChosenLight(graph, light, m_buffers->batch, ray, ray);
        tracePaths(graph, light, m_buffers->batch, ray, ray);
        gather(graph, work, ray);
        addMetLight(graph, light, m_buffers->batch, ray, ray);
    }
    apply(graph, work);
    for (std::uint32_t level = 1; level <= gpu::kBrickLevels; ++level)
    {
        fold(graph, work, level);
    }
    m_frame = work.frame + 1;
}

void RadianceCache::want(vk::FrameGraph& graph, const Work& work)
{
    vk::Pass pass =
        graph.addPass(gpu::radiance::Want{.orthographic = work.camera.orthographic,
                                          .turns = wantingTurns(work.seen.width, work.seen.height, m_buffers->faces)});
    gpu::RadianceWantParams params{};
    params.faces = pass.readWrite(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.counters = pass.readWrite(m_table->counters);
    params.wanted = pass.readWrite(m_buffers->wanted.at(work.frame % 2));
    params.lists = pass.readWrite(m_buffers->batch.lists);
    params.hits = pass.read(work.seen.hits);
    params.live = pass.read(work.seen.live);
    params.forward = work.camera.rays.forward;
    params.half_pixel_x = work.camera.rays.half_pixel_x;
    params.half_pixel_y = work.camera.rays.half_pixel_y;
    params.width = work.seen.width;
    params.height = work.seen.height;
    params.run_count = m_table->run_count;
    params.frame = work.frame;
    pass.dispatchIndirect(work.seen.args, 0, params, work.seen.live.count());
}

void RadianceCache::tally(vk::FrameGraph& graph, const Work& work)
{
    PathBatch& batch = m_buffers->batch;
    vk::Pass pass = graph.addPass(gpu::radiance::Tally{});
    gpu::RadianceTallyParams params{};
    params.faces = pass.read(m_table->faces);
    params.states = pass.read(m_table->states);
    params.wanted = pass.read(m_buffers->wanted.at(work.frame % 2));
    params.counters = pass.readWrite(m_table->counters);
    params.lists = pass.readWrite(batch.lists);
    params.frame = work.frame;
    params.budget = m_buffers->faces;
    pass.dispatchIndirect(batch.lists, listArgs(wantedList(work.frame), gpu::kListPaths), params,
                          divideUp(m_buffers->wanted[0].count(), gpu::kPathGroup));
}

void RadianceCache::take(vk::FrameGraph& graph, const Work& work)
{
    PathBatch& batch = m_buffers->batch;
    vk::Pass pass = graph.addPass(gpu::radiance::Take{});
    gpu::RadianceTakeParams params{};
    params.faces = pass.read(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.wanted = pass.read(m_buffers->wanted.at(work.frame % 2));
    params.counters = pass.read(m_table->counters);
    params.lists = pass.readWrite(batch.lists);
    params.numbers = pass.readWrite(batch.numbers);
    params.frame = work.frame;
    pass.dispatchIndirect(batch.lists, listArgs(wantedList(work.frame), gpu::kListPaths), params,
                          divideUp(m_buffers->wanted[0].count(), gpu::kPathGroup));
}

void RadianceCache::begin(vk::FrameGraph& graph, const Work& work)
{
    PathBatch& batch = m_buffers->batch;
    const bool emits = hasEmission(work.tree);
    vk::Pass pass = graph.addPass(gpu::radiance::Begin{.node_levels = work.tree.grid.nodeLevels(), .emission = emits});
    gpu::RadianceBeginParams params{};
    params.faces = pass.readWrite(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.counters = pass.readWrite(m_table->counters);
    params.gives = pass.read(work.environment.gives());
    if (emits)
    {
        params.light_nodes = pass.read(m_lights.nodes());
    }
    params.lists = pass.readWrite(batch.lists);
    params.numbers = pass.readWrite(batch.numbers);
    params.rays = pass.readWrite(batch.rays[0]);
    params.path_states = pass.readWrite(batch.states[0]);
    params.radiance = pass.readWrite(batch.radiance);
    params.bricks = pass.readWrite(m_buffers->bricks);
    params.batch = static_cast<std::uint32_t>(batch.capacity());
    params.run_count = m_table->run_count;
    params.sample_index = work.frame;
    params.seed = work.options.seed;
    pass.dispatchIndirect(batch.lists, listArgs(0, gpu::kListPaths), params,
                          divideUp(m_buffers->faces, gpu::kPathGroup));
}

void RadianceCache::surround(vk::FrameGraph& graph, std::uint32_t level)
{
    PathBatch& batch = m_buffers->batch;
    vk::Pass pass = graph.addPass(gpu::radiance::Surround{});
    gpu::RadianceSurroundParams params{};
    params.faces = pass.readWrite(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.counters = pass.readWrite(m_table->counters);
    params.lists = pass.readWrite(batch.lists);
    params.bricks = pass.readWrite(m_buffers->bricks);
    params.batch = static_cast<std::uint32_t>(batch.capacity());
    params.run_count = m_table->run_count;
    params.level = level;
    pass.dispatchIndirect(batch.lists, listArgs(gpu::kFirstBricks + level - 2, gpu::kListPaths), params,
                          divideUp(m_buffers->faces, gpu::kPathGroup));
}

// ray: of the paths, 0 or 1.
void RadianceCache::gather(vk::FrameGraph& graph, const Work& work, std::uint32_t ray)
{
    PathBatch& batch = m_buffers->batch;
    const bool emits = hasEmission(work.tree);
    vk::Pass pass = graph.addPass(
        gpu::radiance::Gather{.format = work.tree.attributeFormat(), .emission = emits, .ends = ray != 0});
    gpu::RadianceGatherParams params{};
    params.faces = pass.readWrite(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.counters = pass.readWrite(m_table->counters);
    params.wanted = pass.readWrite(m_buffers->wanted.at((work.frame + 1) % 2));
    params.lists = pass.readWrite(batch.lists);
    params.numbers = pass.readWrite(batch.numbers);
    params.attributes = readVoxelAttributes(pass, work.tree);
    if (emits)
    {
        params.emission_words = pass.read(work.tree.emission_words);
    }
    params.rays = pass.read(batch.rays.at(ray));
    params.hits = pass.read(batch.hits);
    if (ray == 0)
    {
        params.unlit = pass.readWrite(m_buffers->unlit);
    }
    else
    {
        params.path_states = pass.read(batch.states.at(ray));
    }
    params.radiance = pass.readWrite(batch.radiance);
    params.batch = static_cast<std::uint32_t>(batch.capacity());
    params.run_count = m_table->run_count;
    params.frame = work.frame;
    params.first_moving = work.firstMoving().value_or(gpu::kHitMiss);
    pass.dispatchIndirect(batch.lists, listArgs(ray, gpu::kListPaths), params,
                          divideUp(m_buffers->faces, gpu::kPathGroup));
}

void RadianceCache::extend(vk::FrameGraph& graph, const Work& work)
{
    PathBatch& batch = m_buffers->batch;
    const bool emits = hasEmission(work.tree);
    vk::Pass pass = graph.addPass(gpu::radiance::Extend{
        .node_levels = work.tree.grid.nodeLevels(), .format = work.tree.attributeFormat(), .emission = emits});
    gpu::RadianceExtendParams params{};
    params.faces = pass.read(m_table->faces);
    params.states = pass.read(m_table->states);
    params.attributes = readVoxelAttributes(pass, work.tree);
    params.hits = pass.read(batch.hits);
    params.gives = pass.read(work.environment.gives());
    if (emits)
    {
        params.light_nodes = pass.read(m_lights.nodes());
    }
    params.rays = pass.read(batch.rays[0]);
    params.path_states = pass.read(batch.states[0]);
    params.next_rays = pass.readWrite(batch.rays[1]);
    params.next_states = pass.readWrite(batch.states[1]);
    params.lists = pass.readWrite(batch.lists);
    params.numbers = pass.readWrite(batch.numbers);
    params.unlit = pass.read(m_buffers->unlit);
    params.radiance = pass.readWrite(batch.radiance);
    params.batch = static_cast<std::uint32_t>(batch.capacity());
    params.run_count = m_table->run_count;
    params.sample_index = work.frame;
    pass.dispatchIndirect(batch.lists, listArgs(gpu::kUnlitPaths, gpu::kListPaths), params,
                          divideUp(m_buffers->faces, gpu::kPathGroup));
}

void RadianceCache::apply(vk::FrameGraph& graph, const Work& work)
{
    PathBatch& batch = m_buffers->batch;
    vk::Pass pass = graph.addPass(gpu::radiance::Apply{});
    gpu::RadianceApplyParams params{};
    params.faces = pass.readWrite(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.numbers = pass.read(batch.numbers);
    params.radiance = pass.read(batch.radiance);
    params.lists = pass.readWrite(batch.lists);
    params.sums = pass.readWrite(m_buffers->sums);
    params.batch = static_cast<std::uint32_t>(batch.capacity());
    params.run_count = m_table->run_count;
    params.frame = work.frame;
    params.window = std::clamp(work.window, 1U, gpu::kKeptWeightMax);
    params.touched_window = work.moves ? std::min(params.window, gpu::kTouchedSamples) : params.window;
    params.moved_window = work.moves ? std::min(params.window, gpu::kMovedSamples) : params.window;
    pass.dispatchIndirect(batch.lists, listArgs(0, gpu::kListPaths), params,
                          divideUp(m_buffers->faces, gpu::kPathGroup));
}

void RadianceCache::fold(vk::FrameGraph& graph, const Work& work, std::uint32_t level)
{
    PathBatch& batch = m_buffers->batch;
    const auto windowOf = [&](std::uint32_t samples)
    { return std::clamp(gpu::kBrickFaces * std::min(samples, work.window), 1U, gpu::kKeptWeightMax); };
    vk::Pass pass = graph.addPass(gpu::radiance::Fold{});
    gpu::RadianceFoldParams params{};
    params.faces = pass.readWrite(m_table->faces);
    params.states = pass.readWrite(m_table->states);
    params.bricks = pass.read(m_buffers->bricks);
    params.lists = pass.readWrite(batch.lists);
    params.sums = pass.readWrite(m_buffers->sums);
    params.batch = static_cast<std::uint32_t>(batch.capacity());
    params.run_count = m_table->run_count;
    params.frame = work.frame;
    params.level = level;
    params.window = windowOf(work.window);
    params.moved_window = work.moves ? windowOf(gpu::kMovedSamples) : params.window;
    pass.dispatchIndirect(batch.lists, listArgs(gpu::kFirstBricks + level - 1, gpu::kListPaths), params,
                          divideUp(m_buffers->faces, gpu::kPathGroup));
}

} // namespace zvo
