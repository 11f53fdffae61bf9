// SPDX-License-Identifier: MIT
#include "core/path/path_tracer.h"

#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "core/trace/trace_passes.h"
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

/// Lists of paths: of a bounce and of the next one.
constexpr std::size_t kPathLists = 2;

// Elements of the lists of a batch: of all bounces, and of the one that no path reaches.
std::uint64_t batchElements(const PathOptions& options)
{
    return std::uint64_t{std::min(options.bounces, kBouncesMax) + 2} * gpu::kListElements;
}

gpu::PathView viewOf(const Grid& grid, const TraceCamera& camera, const PathOptions& options, std::uint32_t width,
                     std::uint32_t height)
{
    const float unit = 1.0F / (grid.voxel_size * static_cast<float>(grid.rootResolution()));
    return {camera.rays,
            camera.axis,
            width,
            height,
            options.seed,
            options.lens_radius * unit,
            options.focus_distance * unit};
}

// Declares that pass reads what the indices of attributes come from.
void readRanks(vk::AnyPass& pass, const DeviceTree& tree)
{
    rankSource(pass, tree);
    if (tree.hasOverlays())
    {
        pass.read(tree.overlays.ranks);
    }
}

bool isSmooth(const DeviceTree& tree, const PathOptions& options)
{
    return options.smooth && tree.hasAttributes();
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
    : width(picture_width), height(picture_height), form(path_form), status(device, "path/status", 1)
{
    const std::uint64_t pixel_count = std::uint64_t{width} * height;
    const bool in_stages = form == PathForm::Stages;
    const std::uint64_t batch_pixels = in_stages ? std::min(pixel_count, kBatchMax) : 0;
    device.memory().require(pixel_count * sizeof(gpu::PixelSum) + PathBatch::bytesFor(batch_pixels, false),
                            "path tracing");
    sums = {device, "path/sums", pixel_count};
    batch = {device, batch_pixels, false, in_stages ? kBouncesMax + 2 : 1};
    if (!in_stages)
    {
        view = {device, "path/view", 1};
    }
}

void PathTracer::Pixels::addFeatures(vk::Device& device)
{
    const std::uint64_t batch_pixels = batch.capacity(); // 0 in one kernel
    device.memory().require(sums.count() * sizeof(gpu::PixelFeatures) + batch_pixels * sizeof(float), "path tracing");
    if (batch_pixels != 0)
    {
        direct = {device, "path/direct", batch_pixels};
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
    m_lights.forget();
}

std::uint64_t PathTracer::Pixels::bytes() const
{
    // Every member has a name here, or this does not compile: none is forgotten.
    const auto& [own_width, own_height, own_form, sums_, features_, batch_, direct_, status_, view_, is_clear] = *this;
    return sums_.bytes() + features_.bytes() + batch_.bytes() + direct_.bytes() + status_.bytes() + view_.bytes();
}

std::uint64_t PathTracer::bytes() const
{
    return (m_pixels == nullptr ? 0 : m_pixels->bytes()) + m_lights.bytes();
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
    m_lights.prepare(graph, tree);

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
        graph.fill(m_pixels->batch.lists, 0);
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
        graph.copy(m_pixels->batch.lists, 0, *lists, 0, m_pixels->batch.lists.bytes());
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
    const gpu::path::Trace kernel{.orthographic = batch.camera.orthographic,
                                  .format = tree.attributeFormat(),
                                  .emission = emits,
                                  .sampling = options.sampling,
                                  .by_power = options.lights_by_power,
                                  .roulette = options.roulette,
                                  .overlays = tree.hasOverlays(),
                                  .features = options.features,
                                  .smooth_normals = isSmooth(tree, options)};
    vk::Pass pass = graph.addPass(traversing(kernel, tree, {}));
    gpu::PathTraceParams params{};
    params.tree = pass.read(m_lights.table());
    params.nodes = pass.read(tree.nodes);
    params.attributes = readVoxelAttributes(pass, tree);
    m_lights.read(pass, tree, params);
    if (emits)
    {
        params.emission_words = pass.read(tree.emission_words);
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
    params.lists = pass.readWrite(pixels.batch.lists);
    params.status = pass.readWrite(pixels.status);
    params.first_pixel = batch.first_pixel;
    params.pixel_count = batch.pixel_count;
    params.sample_index = m_sample_count;
    params.bounces = std::min(options.bounces, kBouncesMax);
    pass.dispatch(batch.pixel_count, params);
}

void PathTracer::traceInStages(vk::FrameGraph& graph, const Batch& batch)
{
    PathBatch& paths = m_pixels->batch;
    const PathOptions& options = batch.options;
    const std::uint32_t bounces = std::min(options.bounces, kBouncesMax);
    const std::uint64_t list_bytes = batchElements(options) * sizeof(gpu::DispatchArgs);
    graph.fill(paths.lists, 0, 0, list_bytes / sizeof(gpu::uint));
    {
        vk::Pass pass = graph.addPass(gpu::path::Begin{.orthographic = batch.camera.orthographic});
        pass.dispatch(batch.pixel_count, {.rays = pass.write(paths.rays[0]),
                                          .states = pass.write(paths.states[0]),
                                          .radiance = pass.write(paths.radiance),
                                          .lists = pass.readWrite(paths.lists),
                                          .view = m_view,
                                          .first_pixel = batch.first_pixel,
                                          .pixel_count = batch.pixel_count,
                                          .sample_index = m_sample_count});
    }
    PathLight light = {.tree = batch.tree,
                       .environment = batch.environment,
                       .lights = m_lights,
                       .status = m_pixels->status,
                       .sampling = options.sampling,
                       .by_power = options.lights_by_power,
                       .sample_index = m_sample_count,
                       .path_count = batch.pixel_count};
    const bool is_smooth = isSmooth(batch.tree, options);
    for (std::uint32_t bounce = 0; bounce <= bounces; ++bounce)
    {
        tracePaths(graph, light, paths, bounce % kPathLists, bounce);
        shade(graph, batch, bounce);
        light.smooth = is_smooth && bounce == 1;
        addMetLight(graph, light, paths, bounce % kPathLists, bounce);
        if (bounce == 0 && options.features)
        {
            addFeatures(graph, batch);
        }
        if (bounce < bounces && options.sampling != LightSampling::Chance)
        {
            light.smooth = is_smooth && bounce == 0;
            addChosenLight(graph, light, paths, (bounce + 1) % kPathLists, bounce);
        }
    }
    finish(graph, batch);
    if (batch.lists != nullptr)
    {
        graph.copy(paths.lists, 0, *batch.lists, batch.first_pixel / kBatchMax * list_bytes, list_bytes);
    }
}

// Behind what adds the light that the camera sees directly.
void PathTracer::addFeatures(vk::FrameGraph& graph, const Batch& batch)
{
    Pixels& pixels = *m_pixels;
    const DeviceTree& tree = batch.tree;
    vk::Pass pass = graph.addPass(gpu::path::Features{.node_levels = tree.grid.nodeLevels(),
                                                      .format = tree.attributeFormat(),
                                                      .smooth_normals = isSmooth(tree, batch.options)});
    pass.dispatch(batch.pixel_count, {.attributes = readVoxelAttributes(pass, tree),
                                      .rays = pass.read(pixels.batch.rays[0]),
                                      .hits = pass.read(pixels.batch.hits),
                                      .radiance = pass.read(pixels.batch.radiance),
                                      .direct = pass.write(pixels.direct),
                                      .features = pass.readWrite(pixels.features),
                                      .origin = batch.camera.rays.origin,
                                      .axis = batch.camera.axis,
                                      .first_pixel = batch.first_pixel,
                                      .pixel_count = batch.pixel_count});
}

void PathTracer::finish(vk::FrameGraph& graph, const Batch& batch)
{
    vk::Pass pass = graph.addPass(gpu::path::Finish{.features = batch.options.features});
    gpu::PathFinishParams params{};
    params.radiance = pass.read(m_pixels->batch.radiance);
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
    PathBatch& paths = m_pixels->batch;
    const DeviceTree& tree = batch.tree;
    const bool emits = hasEmission(tree);
    vk::Pass pass = graph.addPass(gpu::path::Shade{.node_levels = tree.grid.nodeLevels(),
                                                   .format = tree.attributeFormat(),
                                                   .emission = emits,
                                                   .sampling = batch.options.sampling,
                                                   .last = bounce == std::min(batch.options.bounces, kBouncesMax),
                                                   .roulette = batch.options.roulette,
                                                   .smooth_normals = bounce == 0 && isSmooth(tree, batch.options)});
    pass.dispatchIndirect(paths.lists, listArgs(bounce, gpu::kListPaths),
                          {.attributes = readVoxelAttributes(pass, tree),
                           .emission_words = pass.readIf(emits, tree.emission_words),
                           .hits = pass.read(paths.hits),
                           .gives = pass.read(batch.environment.gives()),
                           .light_nodes = emits ? pass.read(m_lights.nodes()) : gpu::ConstPtr<gpu::LightNode>{},
                           .rays = pass.read(paths.rays.at(bounce % kPathLists)),
                           .states = pass.read(paths.states.at(bounce % kPathLists)),
                           .next_rays = pass.readWrite(paths.rays.at((bounce + 1) % kPathLists)),
                           .next_states = pass.readWrite(paths.states.at((bounce + 1) % kPathLists)),
                           .lists = pass.readWrite(paths.lists),
                           .numbers = pass.readWrite(paths.numbers),
                           .bounce = bounce,
                           .sample_index = m_sample_count,
                           .batch = static_cast<std::uint32_t>(paths.capacity())},
                          divideUp(batch.pixel_count, gpu::kPathGroup));
}

} // namespace zvo
