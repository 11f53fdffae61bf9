// SPDX-License-Identifier: MIT
#include "core/path/path_tracer.h"

#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "core/trace/trace_passes.h"
#include "core/tree/tree_table.h"
#include "vk/device.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace zvo
{

namespace
{

/// Pixels whose paths advance together: so many that a device is busy, so few that their buffers stay small.
constexpr std::uint64_t kBatchMax = std::uint64_t{1} << 19;

/// Rays of one dispatch of path/trace, and pixels below which it is not split: so few that no driver takes it for hung.
constexpr std::uint64_t kDispatchRaysMax = std::uint64_t{1} << 24;
constexpr std::uint64_t kDispatchPixelsMin = std::uint64_t{1} << 17;

/// Threads of a dispatch of path/trace on a GPU, if it has so many pixels: enough for the largest ones.
constexpr std::uint64_t kDispatchThreads = std::uint64_t{1} << 16;

// The element of PathTracer::Pixels::lists with the workgroups for a list.
std::uint64_t argsOf(std::uint32_t bounce, std::uint32_t list)
{
    return std::uint64_t{bounce} * gpu::kListElements + list;
}

// The length of a list.
RayListLength lengthOf(const vk::BufferOf<gpu::DispatchArgs>& lists, std::uint32_t bounce, std::uint32_t list)
{
    constexpr std::uint64_t kWords = sizeof(gpu::DispatchArgs) / sizeof(gpu::uint);
    return {lists, argsOf(bounce, list), kWords * argsOf(bounce, gpu::kListLengths) + list};
}

// Elements of the lists of a batch: of all bounces, and of the one that no path reaches.
std::uint64_t batchElements(const PathOptions& options)
{
    return std::uint64_t{std::min(options.bounces, kBouncesMax) + 2} * gpu::kListElements;
}

// The paths that a thread of path/trace follows, on average. On CPUs one: threads run one after the other there, the
// first of a workgroup would take all; and loops end early there (shared/trace.h).
std::uint32_t pathsOfThread(std::string_view device_type, std::uint64_t pixel_count)
{
    return device_type == "cpu" ? 1 : static_cast<std::uint32_t>(divideUp(pixel_count, kDispatchThreads));
}

gpu::PathView viewOf(const Grid& grid, const TraceCamera& camera, const PathOptions& options, std::uint32_t width,
                     std::uint32_t height)
{
    const float unit = 1.0F / (grid.voxel_size * static_cast<float>(grid.rootResolution()));
    return {camera.rays, width, height, options.seed, options.lens_radius * unit, options.focus_distance * unit};
}

// Declares that pass reads the attributes of voxels, in whatever format they are, and returns where they are.
gpu::ConstPtr<gpu::Attribute> readVoxelAttributes(vk::AnyPass& pass, const DeviceTree& tree)
{
    return isPacked(tree.attributeFormat()) ? gpu::ConstPtr<gpu::Attribute>{pass.read(tree.packed.voxels).address}
                                            : pass.read(tree.voxel_attributes);
}

// Declares that pass reads the ranks of a DAG with attributes.
void readRanks(vk::AnyPass& pass, const DeviceTree& tree)
{
    if (!tree.isDag() || !tree.hasAttributes() || tree.grid.nodeLevels() < 2)
    {
        return;
    }
    rankSource(pass, tree);
    if (tree.hasOverlays())
    {
        pass.read(tree.overlays.ranks);
    }
}

} // namespace

PathForm pathFormOn(const vk::Device& device)
{
    return static_cast<PathForm>(tunedValue(device, Tunable::PathForm));
}

std::uint64_t rayCountOf(std::span<const gpu::DispatchArgs> lists)
{
    std::uint64_t count = 0;
    for (std::size_t first = 0; first + gpu::kListElements <= lists.size(); first += gpu::kListElements)
    {
        const auto* const lengths = reinterpret_cast<const gpu::uint*>(&lists[first + gpu::kListLengths]);
        count += std::uint64_t{lengths[gpu::kListPaths]} + lengths[gpu::kListShadows];
    }
    return count;
}

PathTracer::Pixels::Pixels(vk::Device& device, std::uint32_t picture_width, std::uint32_t picture_height,
                           PathForm path_form)
    : width(picture_width), height(picture_height), form(path_form), status(device, "path/status", 1),
      table(device, "path/tree", 1)
{
    const std::uint64_t pixel_count = std::uint64_t{width} * height;
    const std::uint64_t batch = form == PathForm::Stages ? std::min(pixel_count, kBatchMax) : 0;
    device.memory().require(pixel_count * sizeof(gpu::PixelSum) +
                                batch * (3 * sizeof(gpu::Ray) + 2 * sizeof(gpu::PathState) + sizeof(gpu::Hit) +
                                         sizeof(gpu::ShadowState) + sizeof(gpu::vec3) +
                                         gpu::kListCount * sizeof(gpu::uint)),
                            "path tracing");
    sums = {device, "path/sums", pixel_count};
    if (form == PathForm::OneKernel)
    {
        lists = {device, "path/lists", gpu::kListElements};
        view = {device, "path/view", 1};
        return;
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
        rays.at(i) = {device, "path/rays", batch};
        states.at(i) = {device, "path/states", batch};
    }
    hits = {device, "path/hits", batch};
    shadow_rays = {device, "path/shadow_rays", batch};
    shadow_states = {device, "path/shadow_states", batch};
    radiance = {device, "path/radiance", batch};
    numbers = {device, "path/numbers", gpu::kListCount * batch};
    rounds = {device, "path/rounds", gpu::kTraceRoundsMax};
    lists = {device, "path/lists", std::uint64_t{kBouncesMax + 2} * gpu::kListElements};
}

void PathTracer::Pixels::addFeatures(vk::Device& device)
{
    const std::uint64_t batch = radiance.count(); // 0 in one kernel
    device.memory().require(sums.count() * sizeof(gpu::PixelFeatures) + batch * sizeof(float), "path tracing");
    if (batch != 0)
    {
        direct = {device, "path/direct", batch};
    }
    features = {device, "path/features", sums.count()};
}

/// What a sample of a batch of pixels is traced with.
struct PathTracer::Batch
{
    const DeviceTree& tree;
    const DeviceEnvironment& environment;
    const TraceCamera& camera;
    const PathOptions& options;
    vk::BufferOf<gpu::DispatchArgs>* lists; // of all batches; may be null
    std::uint32_t first_pixel;
    std::uint32_t pixel_count;
};

void PathTracer::resize(std::uint32_t width, std::uint32_t height, std::optional<PathForm> asked)
{
    const PathForm form = asked.value_or(pathFormOn(m_device));
    if (m_pixels == nullptr || m_pixels->width != width || m_pixels->height != height || m_pixels->form != form)
    {
        vk::replace(m_deletion_queue, m_pixels, std::make_unique<Pixels>(m_device, width, height, form));
        m_subject = {};
    }
}

void PathTracer::forget()
{
    m_subject = {};
    m_lights_version = 0;
}

std::uint64_t PathTracer::Pixels::bytes() const
{
    // Every member has a name here, or this does not compile: none is forgotten.
    const auto& [own_width, own_height, own_form, sums_, features_, rays_, states_, hits_, shadow_rays_, shadow_states_,
                 radiance_, direct_, numbers_, rounds_, lists_, status_, table_, view_, is_clear] = *this;
    return sums_.bytes() + features_.bytes() + rays_[0].bytes() + rays_[1].bytes() + states_[0].bytes() +
           states_[1].bytes() + hits_.bytes() + shadow_rays_.bytes() + shadow_states_.bytes() + radiance_.bytes() +
           direct_.bytes() + numbers_.bytes() + rounds_.bytes() + lists_.bytes() + status_.bytes() + table_.bytes() +
           view_.bytes();
}

std::uint64_t PathTracer::bytes() const
{
    const auto ofLights = [](const LightTree& lights)
    {
        return lights.nodes.bytes() + lights.bricks.bytes() + lights.items.bytes() + lights.levels.bytes() +
               lights.args.bytes();
    };
    return (m_pixels == nullptr ? 0 : m_pixels->bytes()) + (m_lights == nullptr ? 0 : ofLights(*m_lights));
}

// Records what is needed before the first sample of a subject.
void PathTracer::begin(vk::FrameGraph& graph, const DeviceTree& tree, const DeviceEnvironment& environment,
                       const TraceCamera& camera, const PathOptions& options)
{
    graph.fill(m_pixels->sums, 0);
    if (options.features)
    {
        graph.fill(m_pixels->features, 0);
    }
    if (!m_pixels->is_status_clear)
    {
        graph.fill(m_pixels->status, 0);
        m_pixels->is_status_clear = true;
    }
    graph.update(m_pixels->table, 0, std::array{treeTable(tree)});
    makeLights(graph, tree);

    ++m_subject_number;
    m_camera = camera;
    m_view = viewOf(tree.grid, camera, options, m_pixels->width, m_pixels->height);
    if (options.reseeds)
    {
        m_view.seed += static_cast<std::uint32_t>(m_subject_number - 1);
    }
    if (m_pixels->form == PathForm::OneKernel)
    {
        graph.update(m_pixels->view, 0, std::array{m_view});
    }
    m_voxel_edge = 1.0F / static_cast<float>(tree.grid.rootResolution());
    Lighting lighting = {environment.version(), {tree.grid.origin, tree.grid.voxel_size}, options};
    lighting.options.seed = 0;
    if (m_lighting != lighting)
    {
        m_lighting = lighting;
        ++m_lighting_number;
    }
}

void PathTracer::makeLights(vk::FrameGraph& graph, const DeviceTree& tree)
{
    if (m_lights_version == tree.version || !hasEmission(tree))
    {
        return;
    }
    if (m_lights == nullptr || !m_lights->suffices(tree))
    {
        vk::replace(m_deletion_queue, m_lights, std::make_unique<LightTree>(m_device, tree));
    }
    m_lights_version = 0; // should the next line throw
    buildLightTree(graph, tree, m_pixels->table, *m_lights);
    m_lights_version = tree.version;
}

std::uint64_t PathTracer::listElements(const PathOptions& options) const
{
    return m_pixels->form == PathForm::OneKernel ? gpu::kListElements
                                                 : divideUp(m_pixels->sums.count(), kBatchMax) * batchElements(options);
}

void PathTracer::addSample(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                           const TraceCamera& camera, const PathOptions& options,
                           vk::BufferOf<gpu::DispatchArgs>* lists)
{
    const Subject subject = {tree.version, environment.version(), std::bit_cast<decltype(Subject::camera)>(camera.rays),
                             camera.orthographic, options};
    if (m_subject != subject)
    {
        m_sample_count = 0;
    }
    m_subject = {}; // should anything below throw: some pixels may have got the sample
    environment.prepare(graph);
    if (options.features && m_pixels->features.count() == 0)
    {
        m_pixels->addFeatures(m_device);
    }
    if (m_sample_count == 0)
    {
        begin(graph, tree, environment, camera, options);
    }
    if (m_pixels->form == PathForm::OneKernel)
    {
        graph.fill(m_pixels->lists, 0);
    }
    const std::uint64_t pixel_count = m_pixels->sums.count();
    const std::uint64_t batch = batchPixels(options.bounces);
    for (std::uint64_t first = 0; first < pixel_count; first += batch)
    {
        const Batch pixels = {tree,
                              environment,
                              camera,
                              options,
                              lists,
                              static_cast<std::uint32_t>(first),
                              static_cast<std::uint32_t>(std::min(batch, pixel_count - first))};
        if (m_pixels->form == PathForm::OneKernel)
        {
            traceInOneKernel(graph, pixels);
        }
        else
        {
            traceInStages(graph, pixels);
        }
    }
    if (m_pixels->form == PathForm::OneKernel && lists != nullptr)
    {
        graph.copy(m_pixels->lists, 0, *lists, 0, m_pixels->lists.bytes());
    }
    ++m_sample_count;
    m_subject = subject;
}

// The most pixels whose paths are traced together.
std::uint64_t PathTracer::batchPixels(std::uint32_t bounces) const
{
    const std::uint64_t rays = 2 * std::uint64_t{std::min(bounces, kBouncesMax)} + 1; // of a path
    return m_pixels->form == PathForm::Stages ? kBatchMax : std::max(kDispatchRaysMax / rays, kDispatchPixelsMin);
}

void PathTracer::traceInOneKernel(vk::FrameGraph& graph, const Batch& batch)
{
    Pixels& pixels = *m_pixels;
    const DeviceTree& tree = batch.tree;
    const PathOptions& options = batch.options;
    const bool emits = hasEmission(tree);
    TraceOptions trace;
    trace.stack = options.stack;
    const gpu::path::Trace kernel{.orthographic = batch.camera.orthographic,
                                  .format = tree.attributeFormat(),
                                  .emission = emits,
                                  .sampling = options.sampling,
                                  .by_power = options.lights_by_power,
                                  .roulette = options.roulette,
                                  .overlays = tree.hasOverlays(),
                                  .features = options.features};
    vk::Pass pass = graph.addPass(traversing(kernel, graph.device(), tree, trace));
    gpu::PathTraceParams params{};
    params.tree = pass.read(pixels.table);
    params.nodes = pass.read(tree.nodes);
    params.attributes = readVoxelAttributes(pass, tree);
    if (emits)
    {
        params.emission_words = pass.read(tree.emission_words);
        pass.read(tree.emission);
        params.light_nodes = pass.read(m_lights->nodes);
        params.light_bricks = pass.read(m_lights->bricks);
    }
    readRanks(pass, tree);
    params.environment = batch.environment.read(pass);
    params.gives = pass.read(batch.environment.gives());
    params.view = pass.read(pixels.view);
    params.sums = pass.readWrite(pixels.sums);
    if (options.features)
    {
        params.features = pass.readWrite(pixels.features);
    }
    params.lists = pass.readWrite(pixels.lists);
    params.status = pass.readWrite(pixels.status);
    params.first_pixel = batch.first_pixel;
    params.end_pixel = batch.first_pixel + batch.pixel_count;
    params.sample_index = m_sample_count;
    params.bounces = std::min(options.bounces, kBouncesMax);
    params.paths_of_thread = options.paths_of_thread != 0 ? options.paths_of_thread
                                                          : pathsOfThread(m_device.report().type, batch.pixel_count);
    pass.dispatch(
        divideUp(batch.pixel_count, std::uint64_t{gpu::kPathGroup} * params.paths_of_thread) * gpu::kPathGroup, params);
}

void PathTracer::traceInStages(vk::FrameGraph& graph, const Batch& batch)
{
    Pixels& pixels = *m_pixels;
    const std::uint32_t bounces = std::min(batch.options.bounces, kBouncesMax);
    const std::uint64_t list_bytes = batchElements(batch.options) * sizeof(gpu::DispatchArgs);
    graph.fill(pixels.lists, 0, 0, list_bytes / sizeof(gpu::uint));
    {
        vk::Pass pass = graph.addPass(gpu::path::Begin{.orthographic = batch.camera.orthographic});
        gpu::PathBeginParams params{};
        params.rays = pass.write(pixels.rays[0]);
        params.states = pass.write(pixels.states[0]);
        params.radiance = pass.write(pixels.radiance);
        params.lists = pass.readWrite(pixels.lists);
        params.view = m_view;
        params.first_pixel = batch.first_pixel;
        params.pixel_count = batch.pixel_count;
        params.sample_index = m_sample_count;
        pass.dispatch(batch.pixel_count, params);
    }
    TraceOptions trace;
    trace.stack = batch.options.stack;
    for (std::uint32_t bounce = 0; bounce <= bounces; ++bounce)
    {
        const RayListLength paths = lengthOf(pixels.lists, bounce, gpu::kListPaths);
        traceRays(graph, batch.tree, pixels.rays.at(bounce % 2), pixels.hits, pixels.rounds, pixels.status, trace,
                  &paths);
        shade(graph, batch, bounce);
        const LightSampling sampling = batch.options.sampling;
        const bool by_power = batch.options.lights_by_power;
        const std::uint32_t levels = batch.tree.grid.nodeLevels();
        const bool emits = hasEmission(batch.tree);
        takeList(graph, gpu::path::Miss{.sampling = sampling}, gpu::kListMisses, batch, bounce);
        if (emits)
        {
            takeList(graph, gpu::path::Emitter{.sampling = sampling, .node_levels = levels, .by_power = by_power},
                     gpu::kListEmitters, batch, bounce);
        }
        if (bounce == 0 && batch.options.features)
        {
            addFeatures(graph, batch);
        }
        if (bounce == bounces || sampling == LightSampling::Chance)
        {
            continue;
        }
        takeList(graph, gpu::path::MapLight{.sampling = sampling}, gpu::kListMapLights, batch, bounce);
        if (emits)
        {
            takeList(graph, gpu::path::VoxelLight{.sampling = sampling, .node_levels = levels, .by_power = by_power},
                     gpu::kListVoxelLights, batch, bounce);
        }
        const RayListLength shadows = lengthOf(pixels.lists, bounce, gpu::kListShadows);
        traceRays(graph, batch.tree, pixels.shadow_rays, pixels.hits, pixels.rounds, pixels.status, trace, &shadows);
        vk::Pass pass = graph.addPass(gpu::path::Connect{});
        const gpu::PathConnectParams params = {pass.read(pixels.hits), pass.read(pixels.shadow_states),
                                               pass.readWrite(pixels.radiance), pass.readWrite(pixels.lists), bounce};
        pass.dispatchIndirect(pixels.lists, shadows.args, params, divideUp(batch.pixel_count, gpu::kPathGroup));
    }
    finish(graph, batch);
    if (batch.lists != nullptr)
    {
        graph.copy(pixels.lists, 0, *batch.lists, batch.first_pixel / kBatchMax * list_bytes, list_bytes);
    }
}

// Behind what adds the light that the camera sees directly.
void PathTracer::addFeatures(vk::FrameGraph& graph, const Batch& batch)
{
    Pixels& pixels = *m_pixels;
    const DeviceTree& tree = batch.tree;
    vk::Pass pass =
        graph.addPass(gpu::path::Features{.node_levels = tree.grid.nodeLevels(), .format = tree.attributeFormat()});
    gpu::PathFeaturesParams params{};
    params.attributes = readVoxelAttributes(pass, tree);
    params.rays = pass.read(pixels.rays[0]);
    params.hits = pass.read(pixels.hits);
    params.radiance = pass.read(pixels.radiance);
    params.direct = pass.write(pixels.direct);
    params.features = pass.readWrite(pixels.features);
    params.origin = batch.camera.rays.origin;
    params.forward = batch.camera.rays.forward;
    params.first_pixel = batch.first_pixel;
    params.pixel_count = batch.pixel_count;
    pass.dispatch(batch.pixel_count, params);
}

void PathTracer::finish(vk::FrameGraph& graph, const Batch& batch)
{
    vk::Pass pass = graph.addPass(gpu::path::Finish{.features = batch.options.features});
    gpu::PathFinishParams params{};
    params.radiance = pass.read(m_pixels->radiance);
    if (batch.options.features)
    {
        params.direct = pass.read(m_pixels->direct);
        params.features = pass.readWrite(m_pixels->features);
    }
    params.sums = pass.readWrite(m_pixels->sums);
    params.first_pixel = batch.first_pixel;
    params.pixel_count = batch.pixel_count;
    pass.dispatch(batch.pixel_count, params);
}

void PathTracer::shade(vk::FrameGraph& graph, const Batch& batch, std::uint32_t bounce)
{
    Pixels& pixels = *m_pixels;
    const DeviceTree& tree = batch.tree;
    const bool emits = hasEmission(tree);
    vk::Pass pass = graph.addPass(gpu::path::Shade{.node_levels = tree.grid.nodeLevels(),
                                                   .format = tree.attributeFormat(),
                                                   .emission = emits,
                                                   .sampling = batch.options.sampling,
                                                   .last = bounce == std::min(batch.options.bounces, kBouncesMax),
                                                   .roulette = batch.options.roulette});
    gpu::PathShadeParams params{};
    params.attributes = readVoxelAttributes(pass, tree);
    params.hits = pass.read(pixels.hits);
    params.gives = pass.read(batch.environment.gives());
    if (emits)
    {
        params.emission_words = pass.read(tree.emission_words);
        params.light_nodes = pass.read(m_lights->nodes);
    }
    params.rays = pass.read(pixels.rays.at(bounce % 2));
    params.states = pass.read(pixels.states.at(bounce % 2));
    params.next_rays = pass.readWrite(pixels.rays.at((bounce + 1) % 2));
    params.next_states = pass.readWrite(pixels.states.at((bounce + 1) % 2));
    params.lists = pass.readWrite(pixels.lists);
    params.numbers = pass.readWrite(pixels.numbers);
    params.bounce = bounce;
    params.sample_index = m_sample_count;
    params.batch = static_cast<std::uint32_t>(pixels.radiance.count());
    pass.dispatchIndirect(pixels.lists, argsOf(bounce, gpu::kListPaths), params,
                          divideUp(batch.pixel_count, gpu::kPathGroup));
}

template <typename Kernel>
void PathTracer::takeList(vk::FrameGraph& graph, const Kernel& kernel, std::uint32_t list, const Batch& batch,
                          std::uint32_t bounce)
{
    Pixels& pixels = *m_pixels;
    const bool looks_for_light = list == gpu::kListMapLights || list == gpu::kListVoxelLights;
    const std::uint32_t paths = (bounce + (looks_for_light ? 1 : 0)) % 2; // which of both lists they are in
    vk::Pass pass = graph.addPass(kernel);
    gpu::PathLightParams params{};
    params.environment = batch.environment.read(pass);
    if (hasEmission(batch.tree))
    {
        params.tree = pass.read(pixels.table);
        pass.read(batch.tree.emission_words);
        pass.read(batch.tree.emission);
        params.light_nodes = pass.read(m_lights->nodes);
        params.light_bricks = pass.read(m_lights->bricks);
    }
    params.rays = pass.read(pixels.rays.at(paths));
    params.states = pass.read(pixels.states.at(paths));
    params.hits = pass.read(pixels.hits);
    params.shadow_rays = pass.readWrite(pixels.shadow_rays);
    params.shadow_states = pass.readWrite(pixels.shadow_states);
    params.radiance = pass.readWrite(pixels.radiance);
    params.lists = pass.readWrite(pixels.lists);
    params.numbers = pass.read(pixels.numbers);
    params.bounce = bounce;
    params.sample_index = m_sample_count;
    params.batch = static_cast<std::uint32_t>(pixels.radiance.count());
    pass.dispatchIndirect(pixels.lists, argsOf(bounce, list), params, divideUp(batch.pixel_count, gpu::kPathGroup));
}

} // namespace zvo
