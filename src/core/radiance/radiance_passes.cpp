// SPDX-License-Identifier: MIT
#include "core/radiance/radiance_passes.h"

#include "core/base/divide_up.h"
#include "vk/device.h"

#include <algorithm>

namespace zvo
{

namespace
{

constexpr const char* kPurpose = "light on voxels";

// The rays of a path, at most: a second one where the first has hit a face without light.
constexpr std::uint32_t kFaceRays = 2;

std::uint64_t quadsOf(std::uint32_t width, std::uint32_t height)
{
    return std::uint64_t{divideUp(width, 2U)} * divideUp(height, 2U);
}

// How many pixels of each 2x2 list their face in a frame: the camera lists about as many faces as a frame may take, or
// one for each 2x2 where that is more.
std::uint32_t requestTurns(std::uint32_t width, std::uint32_t height, std::uint32_t faces)
{
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(faces / quadsOf(width, height), 1, 4));
}

// The list of the faces that a frame takes, as a bounce of PathBatch::lists.
std::uint32_t requestedList(std::uint32_t frame)
{
    return gpu::kWantedEven + frame % 2;
}

// Records what a frame needs cleared.
void clear(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    constexpr std::uint64_t kWords = gpu::kListElements * sizeof(gpu::DispatchArgs) / sizeof(gpu::uint);
    PathBatch& batch = frame.lists.batch;
    if (frame.number == 0)
    {
        graph.fill(frame.table.faces, 0);
        graph.fill(frame.table.states, 0);
        graph.fill(frame.counters, 0);
        graph.fill(frame.status, 0);
        graph.fill(batch.lists, 0);
        return;
    }
    graph.fill(batch.lists, 0, 0, gpu::kWantedEven * kWords);
    graph.fill(batch.lists, 0, requestedList(frame.number + 1) * kWords, kWords);
    graph.fill(batch.lists, 0, gpu::kFirstBricks * kWords, gpu::kBrickLevels * kWords);
    graph.fill(frame.counters, 0, gpu::kCountersOfFrame,
               sizeof(gpu::RadianceCounters) / sizeof(gpu::uint) - gpu::kCountersOfFrame);
}

void request(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    vk::Pass pass = graph.addPass(
        gpu::radiance::Request{.orthographic = frame.camera.orthographic,
                               .turns = requestTurns(frame.seen.width, frame.seen.height, frame.lists.faces)});
    pass.dispatchIndirect(frame.seen.args, 0,
                          {.faces = pass.readWrite(frame.table.faces),
                           .states = pass.readWrite(frame.table.states),
                           .counters = pass.readWrite(frame.counters),
                           .wanted = pass.readWrite(frame.lists.wanted),
                           .lists = pass.readWrite(frame.lists.batch.lists),
                           .hits = pass.read(frame.seen.hits),
                           .live = pass.read(frame.seen.live),
                           .forward = frame.camera.rays.forward,
                           .half_pixel_x = frame.camera.rays.half_pixel_x,
                           .half_pixel_y = frame.camera.rays.half_pixel_y,
                           .width = frame.seen.width,
                           .height = frame.seen.height,
                           .run_count = frame.table.run_count,
                           .frame = frame.number},
                          frame.seen.live.count());
}

void count(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    PathBatch& batch = frame.lists.batch;
    vk::Pass pass = graph.addPass(gpu::radiance::Count{});
    pass.dispatchIndirect(batch.lists, listArgs(requestedList(frame.number), gpu::kListPaths),
                          {.faces = pass.read(frame.table.faces),
                           .states = pass.read(frame.table.states),
                           .wanted = pass.read(frame.lists.wanted),
                           .counters = pass.readWrite(frame.counters),
                           .lists = pass.readWrite(batch.lists),
                           .frame = frame.number,
                           .budget = frame.lists.faces},
                          divideUp(frame.lists.wanted.count(), gpu::kPathGroup));
}

void select(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    PathBatch& batch = frame.lists.batch;
    vk::Pass pass = graph.addPass(gpu::radiance::Select{});
    pass.dispatchIndirect(batch.lists, listArgs(requestedList(frame.number), gpu::kListPaths),
                          {.faces = pass.read(frame.table.faces),
                           .states = pass.readWrite(frame.table.states),
                           .wanted = pass.read(frame.lists.wanted),
                           .counters = pass.read(frame.counters),
                           .lists = pass.readWrite(batch.lists),
                           .numbers = pass.readWrite(batch.numbers),
                           .frame = frame.number},
                          divideUp(frame.lists.wanted.count(), gpu::kPathGroup));
}

void begin(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    PathBatch& batch = frame.lists.batch;
    const bool emits = hasEmission(frame.tree);
    vk::Pass pass = graph.addPass(gpu::radiance::Begin{.node_levels = frame.tree.grid.nodeLevels(), .emission = emits});
    pass.dispatchIndirect(batch.lists, listArgs(0, gpu::kListPaths),
                          {.faces = pass.read(frame.table.faces),
                           .gives = pass.read(frame.environment.gives()),
                           .light_nodes = emits ? pass.read(frame.lights.nodes()) : gpu::ConstPtr<gpu::LightNode>{},
                           .lists = pass.readWrite(batch.lists),
                           .numbers = pass.readWrite(batch.numbers),
                           .rays = pass.readWrite(batch.rays[0]),
                           .path_states = pass.readWrite(batch.states[0]),
                           .radiance = pass.readWrite(batch.radiance),
                           .batch = static_cast<std::uint32_t>(batch.capacity()),
                           .sample_index = frame.number,
                           .seed = frame.seed},
                          divideUp(frame.lists.faces, gpu::kPathGroup));
}

// Bricks are listed when paths have ended: lists of them take the place of hits, their sums that of rays.
gpu::Ptr<gpu::uint> bricksOf(vk::AnyPass& pass, PathBatch& batch, std::uint32_t level)
{
    static_assert(gpu::kBrickLevels * sizeof(gpu::uint) <= sizeof(gpu::Hit));
    return {pass.readWrite(batch.hits).address + (level - 1) * batch.capacity() * sizeof(gpu::uint)};
}

gpu::Ptr<gpu::BrickSum> brickSums(vk::AnyPass& pass, PathBatch& batch, std::uint32_t level)
{
    static_assert(sizeof(gpu::BrickSum) <= sizeof(gpu::Ray));
    return {pass.readWrite(batch.rays.at((level - 1) % 2)).address};
}

void surround(vk::FrameGraph& graph, const RadianceFrame& frame, std::uint32_t level)
{
    PathBatch& batch = frame.lists.batch;
    const std::uint32_t of = level == 1 ? 0 : gpu::kFirstBricks + level - 2;
    vk::Pass pass = graph.addPass(gpu::radiance::Surround{});
    pass.dispatchIndirect(
        batch.lists, listArgs(of, gpu::kListPaths),
        {.faces = pass.readWrite(frame.table.faces),
         .states = pass.readWrite(frame.table.states),
         .counters = pass.readWrite(frame.counters),
         .lists = pass.readWrite(batch.lists),
         .slots = {level == 1 ? pass.read(batch.numbers).address : bricksOf(pass, batch, level - 1).address},
         .bricks = bricksOf(pass, batch, level),
         .of = of,
         .run_count = frame.table.run_count,
         .level = level},
        divideUp(frame.lists.faces, gpu::kPathGroup));
}

// ray: of the paths, 0 or 1.
void gather(vk::FrameGraph& graph, const RadianceFrame& frame, std::uint32_t ray)
{
    PathBatch& batch = frame.lists.batch;
    const bool emits = hasEmission(frame.tree);
    vk::Pass pass = graph.addPass(
        gpu::radiance::Gather{.format = frame.tree.attributeFormat(), .emission = emits, .ends = ray != 0});
    gpu::RadianceGatherParams params{};
    params.faces = pass.readWrite(frame.table.faces);
    params.states = pass.readWrite(frame.table.states);
    params.counters = pass.readWrite(frame.counters);
    params.wanted = pass.readWrite(frame.lists.wanted);
    params.lists = pass.readWrite(batch.lists);
    params.numbers = pass.readWrite(batch.numbers);
    params.attributes = readVoxelAttributes(pass, frame.tree);
    if (emits)
    {
        params.emission_words = pass.read(frame.tree.emission_words);
    }
    params.rays = pass.read(batch.rays.at(ray));
    params.hits = pass.read(batch.hits);
    params.path_states = pass.readIf(ray != 0, batch.states.at(ray));
    params.radiance = pass.readWrite(batch.radiance);
    params.batch = static_cast<std::uint32_t>(batch.capacity());
    params.run_count = frame.table.run_count;
    params.frame = frame.number;
    params.first_moving = frame.firstMoving().value_or(gpu::kHitMiss);
    pass.dispatchIndirect(batch.lists, listArgs(ray, gpu::kListPaths), params,
                          divideUp(frame.lists.faces, gpu::kPathGroup));
}

void extend(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    PathBatch& batch = frame.lists.batch;
    const bool emits = hasEmission(frame.tree);
    vk::Pass pass = graph.addPass(gpu::radiance::Extend{
        .node_levels = frame.tree.grid.nodeLevels(), .format = frame.tree.attributeFormat(), .emission = emits});
    pass.dispatchIndirect(batch.lists, listArgs(gpu::kUnlitPaths, gpu::kListPaths),
                          {.faces = pass.read(frame.table.faces),
                           .states = pass.read(frame.table.states),
                           .attributes = readVoxelAttributes(pass, frame.tree),
                           .hits = pass.read(batch.hits),
                           .gives = pass.read(frame.environment.gives()),
                           .light_nodes = emits ? pass.read(frame.lights.nodes()) : gpu::ConstPtr<gpu::LightNode>{},
                           .rays = pass.read(batch.rays[0]),
                           .path_states = pass.read(batch.states[0]),
                           .next_rays = pass.readWrite(batch.rays[1]),
                           .next_states = pass.readWrite(batch.states[1]),
                           .lists = pass.readWrite(batch.lists),
                           .numbers = pass.readWrite(batch.numbers),
                           .radiance = pass.readWrite(batch.radiance),
                           .batch = static_cast<std::uint32_t>(batch.capacity()),
                           .run_count = frame.table.run_count,
                           .sample_index = frame.number},
                          divideUp(frame.lists.faces, gpu::kPathGroup));
}

void update(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    PathBatch& batch = frame.lists.batch;
    const std::uint32_t window = std::clamp(frame.window, 1U, gpu::kCachedWeightMax);
    vk::Pass pass = graph.addPass(gpu::radiance::Update{});
    pass.dispatchIndirect(batch.lists, listArgs(0, gpu::kListPaths),
                          {.faces = pass.readWrite(frame.table.faces),
                           .states = pass.readWrite(frame.table.states),
                           .numbers = pass.read(batch.numbers),
                           .radiance = pass.read(batch.radiance),
                           .lists = pass.readWrite(batch.lists),
                           .sums = brickSums(pass, batch, 1),
                           .run_count = frame.table.run_count,
                           .frame = frame.number,
                           .window = window,
                           .touched_window = frame.moves ? std::min(window, gpu::kTouchedSamples) : window,
                           .moved_window = frame.moves ? std::min(window, gpu::kMovedSamples) : window},
                          divideUp(frame.lists.faces, gpu::kPathGroup));
}

void updateBricks(vk::FrameGraph& graph, const RadianceFrame& frame, std::uint32_t level)
{
    PathBatch& batch = frame.lists.batch;
    const auto windowOf = [&](std::uint32_t samples)
    { return std::clamp(gpu::kBrickFaces * std::min(samples, frame.window), 1U, gpu::kCachedWeightMax); };
    vk::Pass pass = graph.addPass(gpu::radiance::UpdateBricks{});
    pass.dispatchIndirect(batch.lists, listArgs(gpu::kFirstBricks + level - 1, gpu::kListPaths),
                          {.faces = pass.readWrite(frame.table.faces),
                           .states = pass.readWrite(frame.table.states),
                           .bricks = {bricksOf(pass, batch, level).address},
                           .lists = pass.readWrite(batch.lists),
                           .sums = brickSums(pass, batch, level),
                           .outer_sums = brickSums(pass, batch, level + 1),
                           .run_count = frame.table.run_count,
                           .frame = frame.number,
                           .level = level,
                           .window = windowOf(frame.window),
                           .moved_window = windowOf(frame.moves ? gpu::kMovedSamples : frame.window)},
                          divideUp(frame.lists.faces, gpu::kPathGroup));
}

} // namespace

RadianceTable::RadianceTable(vk::Device& device, std::uint64_t runs) : run_count(static_cast<std::uint32_t>(runs))
{
    const std::uint64_t slots = gpu::kFaceRun * runs;
    device.memory().require(slots * (sizeof(gpu::CachedFace) + sizeof(gpu::FaceState)), kPurpose);
    faces = {device, "radiance/faces", slots};
    states = {device, "radiance/states", slots};
}

RadianceLists::RadianceLists(vk::Device& device, std::uint32_t face_count, std::uint32_t picture_width,
                             std::uint32_t picture_height)
    : faces(face_count), width(picture_width), height(picture_height)
{
    // The camera lists a face for each pixel that takes part, and the paths of a frame one for each of their rays.
    const std::uint64_t wanted_max =
        kFaceRays * std::uint64_t{faces} + quadsOf(width, height) * requestTurns(width, height, faces);
    device.memory().require(PathBatch::bytesFor(faces, true) + wanted_max * sizeof(gpu::uint), kPurpose);
    wanted = {device, "radiance/wanted", wanted_max};
    batch = {device, faces, true, gpu::kFirstBricks + gpu::kBrickLevels};
}

std::uint64_t RadianceLists::bytes() const
{
    return wanted.bytes() + batch.bytes();
}

void sampleFaces(vk::FrameGraph& graph, const RadianceFrame& frame)
{
    clear(graph, frame);
    request(graph, frame);
    count(graph, frame);
    select(graph, frame);
    begin(graph, frame);
    PathBatch& batch = frame.lists.batch;
    for (std::uint32_t ray = 0; ray < kFaceRays; ++ray)
    {
        if (ray != 0)
        {
            extend(graph, frame);
        }
        // Only first rays are noted: what second ones find is the light of other faces.
        const PathLight light = {.tree = frame.tree,
                                 .environment = frame.environment,
                                 .lights = frame.lights,
                                 .status = frame.status,
                                 .sample_index = frame.number,
                                 .path_count = frame.lists.faces,
                                 .first_noted = ray == 0 ? frame.firstMoving() : std::nullopt};
        addChosenLight(graph, light, batch, ray, ray);
        tracePaths(graph, light, batch, ray, ray);
        gather(graph, frame, ray);
        addMetLight(graph, light, batch, ray, ray);
    }
    for (vk::BufferOf<gpu::Ray>& rays : batch.rays)
    {
        graph.fill(rays, 0);
    }
    for (std::uint32_t level = 1; level <= gpu::kBrickLevels; ++level)
    {
        surround(graph, frame, level);
    }
    update(graph, frame);
    for (std::uint32_t level = 1; level <= gpu::kBrickLevels; ++level)
    {
        updateBricks(graph, frame, level);
    }
}

} // namespace zvo
