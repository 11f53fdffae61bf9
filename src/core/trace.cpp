// SPDX-License-Identifier: MIT
#include "core/trace.h"

#include "core/divide_up.h"
#include "core/trace_ranks.h"
#include "vk/device.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace zvo
{

namespace
{

constexpr std::uint64_t kPathCellCount = std::uint64_t{gpu::kPathCells} * gpu::kPathCells * gpu::kPathCells;
constexpr std::uint32_t kBlack = 255U << 24;

struct PictureTiles
{
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t blocks;

    explicit PictureTiles(const TraceBuffers& buffers)
        : x((buffers.width + gpu::kTileEdge - 1) / gpu::kTileEdge),
          y((buffers.height + gpu::kTileEdge - 1) / gpu::kTileEdge),
          blocks(((x + gpu::kBlockEdge - 1) / gpu::kBlockEdge) * ((y + gpu::kBlockEdge - 1) / gpu::kBlockEdge))
    {
    }
};

bool isEmpty(const Octree& octree)
{
    return octree.node_count == 0;
}

// Whether the octree has cells as small as the beam grid's finer ones.
bool hasFineBeam(const Octree& octree)
{
    return octree.grid.nodeLevels() > gpu::kBeamLevels;
}

// Whether all nodes that paths name have children which are nodes.
bool hasPaths(const Octree& octree)
{
    return octree.grid.nodeLevels() > gpu::kPathLevels;
}

// Whether the nodes stand level by level, with nothing behind them: what no update has changed.
bool standsByLevels(const TreeView& tree)
{
    const Octree& octree = tree.octree();
    if (octree.levels.empty())
    {
        return false;
    }
    const Octree::Level& last = octree.levels.back();
    const std::uint64_t node_count = tree.svdag() != nullptr ? octree.node_count : octree.nodes.count();
    return std::uint64_t{last.first_node} + last.node_count == node_count;
}

// Attributes for every hit that can occur.
bool usesAttributes(const Octree& octree, const TraceOptions& options)
{
    return octree.hasAttributes() && (!options.hasDetail() || octree.hasNodeAttributes());
}

// The form in which kernels read attributes; None: they need not.
std::uint32_t formToRead(const Octree& octree, const TraceOptions& options)
{
    return static_cast<std::uint32_t>(usesAttributes(octree, options) ? octree.attributeForm() : AttributeForm::None);
}

// Attributes, whatever their form.
template <typename Params> void readAttributes(vk::Pass& pass, const Octree& octree, Params& params)
{
    if (isPacked(octree.attributeForm()))
    {
        params.attributes = {pass.read(octree.packed.voxels).address};
        params.node_attributes = {pass.read(octree.packed.nodes).address};
        return;
    }
    params.attributes = pass.read(octree.voxel_attributes);
    params.node_attributes = pass.read(octree.node_attributes);
}

bool showsAttributes(const TraceOptions& options)
{
    return options.view == View::Color || options.view == View::Albedo || options.view == View::Normal;
}

// The constants that every kernel with lib/traverse.glsl begins with.
vk::Specialization traverseConstants(const TreeView& tree, const TraceOptions& options)
{
    return {tree.octree().grid.nodeLevels(), static_cast<std::uint32_t>(options.stack), options.hasDetail() ? 1U : 0U,
            options.steps_max, tree.entriesPerWord()};
}

vk::Specialization withConstants(vk::Specialization constants, std::initializer_list<std::uint32_t> more)
{
    constants.insert(constants.end(), more.begin(), more.end());
    return constants;
}

vk::Specialization withFlags(vk::Specialization constants, std::initializer_list<bool> more)
{
    constants.insert(constants.end(), more.begin(), more.end());
    return constants;
}

// How many rounds answer every ray: for a grid of n voxels per edge it crosses at most 3 n planes and goes down into at
// most n nodes, and once from the root in each round.
std::uint32_t roundsFor(const Octree& octree, const TraceOptions& options)
{
    const std::uint64_t steps = std::uint64_t{4} * octree.grid.resolution() + gpu::kTraceRoundsMax * 16;
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(divideUp(steps, options.steps_max), gpu::kTraceRoundsMax));
}

// Records a pass for each round that rays may need: declare() returns what its kernel takes. The first goes as
// dispatch_first says, the others over as many workgroups as the round before asks for (max_groups at most): none, once
// all rays are answered.
template <typename Params, typename Declare, typename Dispatch>
void addRounds(vk::FrameGraph& graph, const char* kernel, const vk::Specialization& constants,
               std::uint32_t round_count, vk::BufferOf<gpu::DispatchArgs>& rounds, std::uint64_t max_groups,
               const Declare& declare, const Dispatch& dispatch_first)
{
    if (round_count > 1)
    {
        graph.fill(rounds, 0);
    }
    for (std::uint32_t round = 0; round < round_count; ++round)
    {
        const bool more = round + 1 < round_count;
        vk::Pass pass = graph.addPass(kernel, withFlags(constants, {round != 0, more}));
        Params params = declare(pass);
        params.rounds = more ? pass.readWrite(rounds) : gpu::Ptr<gpu::DispatchArgs>{};
        params.round = round + 1;
        if (round == 0)
        {
            dispatch_first(pass, params);
        }
        else
        {
            pass.dispatchIndirect(rounds, round, params, max_groups);
        }
    }
}

// Nodes whose edge is at most max(x * t, y) stop a ray.
gpu::vec2 detailOf(const TraceOptions& options, const TraceCamera* camera)
{
    gpu::vec2 detail(0.0F);
    if (options.detail_level != UINT32_MAX)
    {
        detail.y = std::ldexp(1.0F, -2 * static_cast<int>(std::min(options.detail_level, gpu::kNodeLevelsMax)));
    }
    if (camera != nullptr)
    {
        const float width = 2.0F * glm::length(camera->rays.step_x) * options.detail_pixels;
        float& part = camera->orthographic ? detail.y : detail.x;
        part = std::max(part, width);
    }
    return detail;
}

gpu::vec3 sunDirection(const TraceOptions& options)
{
    const double length = glm::length(options.to_sun);
    return length > 0.0 ? gpu::vec3(options.to_sun / length) : gpu::vec3(0.0F, 1.0F, 0.0F);
}

// Least and greatest depth of the grid in front of the camera, in unit space.
gpu::vec2 depthRange(const Grid& grid, const TraceCamera& camera)
{
    const float edge = static_cast<float>(grid.resolution()) / static_cast<float>(grid.rootResolution());
    const gpu::vec3& forward = camera.rays.forward;
    const float middle = glm::dot(gpu::vec3(1.0F + 0.5F * edge) - camera.rays.origin, forward);
    const float reach = 0.5F * edge * (std::fabs(forward.x) + std::fabs(forward.y) + std::fabs(forward.z));
    return {std::max(middle - reach, 0.0F), std::max(middle + reach, 1e-6F)};
}

// A number near the golden section of count that shares no factor with it.
std::uint32_t coprimeStride(std::uint32_t count)
{
    auto stride = static_cast<std::uint32_t>(0.618 * count) | 1U;
    while (std::gcd(stride, count) != 1)
    {
        ++stride;
    }
    return stride;
}

bool needsLight(const TraceOptions& options)
{
    return options.view == View::Color && (options.shadows || options.occlusion_rays != 0);
}

// The first round of the rays of live tiles.
auto dispatchLive(const TraceBuffers& buffers)
{
    return [&](vk::Pass& pass, const auto& params)
    { pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count()); };
}

// What the passes have in common that trace rays from hits.
template <typename Params>
Params lightParams(vk::Pass& pass, const Octree& octree, const TraceCamera& camera, TraceBuffers& buffers)
{
    Params params{};
    params.nodes = pass.read(octree.nodes);
    params.live = pass.read(buffers.live);
    params.hits = pass.read(buffers.hits);
    readAttributes(pass, octree, params);
    params.status = pass.readWrite(buffers.status);
    params.forward = camera.rays.forward;
    params.step_x = camera.rays.step_x;
    params.step_y = camera.rays.step_y;
    params.width = buffers.width;
    params.height = buffers.height;
    return params;
}

void traceBeam(vk::FrameGraph& graph, const Octree& octree, const BeamGrid& beam, const TraceCamera& camera,
               const TraceOptions& options, TraceBuffers& buffers)
{
    graph.fill(buffers.live, gpu::kNoTile);
    graph.fill(buffers.args, 0);
    graph.fill(buffers.status, 0);
    const PictureTiles tiles(buffers);
    const bool fine = hasFineBeam(octree);
    const vk::Specialization constants =
        withFlags({gpu::kBeamLevels + (fine ? 1 : 0), static_cast<std::uint32_t>(options.stack), fine ? 1U : 0U,
                   gpu::kTraceStepsMax},
                  {false, camera.orthographic, options.beam, isEmpty(octree)});
    vk::Pass pass = graph.addPass("trace/beam", constants);
    gpu::BeamParams params{};
    params.nodes = pass.read(beam.nodes);
    params.starts = pass.write(buffers.starts);
    params.live = pass.write(buffers.live);
    params.args = pass.readWrite(buffers.args);
    params.status = pass.readWrite(buffers.status);
    params.camera = camera.rays;
    params.width = buffers.width;
    params.height = buffers.height;
    params.block_stride = coprimeStride(tiles.blocks);
    params.detail = detailOf(options, &camera);
    pass.dispatch(std::uint64_t{tiles.blocks} * gpu::kBlockTiles, params);
}

} // namespace

BeamGrid::BeamGrid(vk::Device& device, bool for_dag)
    : occupied(device, "beam occupied", gpu::kBeamRows), rows(device, "beam rows", gpu::kBeamRows),
      masks(device, "beam masks", gpu::kBeamMasks), nodes(device, "beam nodes", gpu::kBeamNodes),
      paths(device, "paths", for_dag ? std::uint64_t{gpu::kRankTableOverlays} + 1 : kPathCellCount)
{
}

TraceBuffers::TraceBuffers(vk::Device& device, std::uint32_t picture_width, std::uint32_t picture_height)
    : width(picture_width), height(picture_height), args(device, "trace args", 1),
      rounds(device, "trace rounds", gpu::kTraceRoundsMax), status(device, "trace status", 1)
{
    const PictureTiles tiles(*this);
    const std::uint64_t tile_count = std::uint64_t{tiles.x} * tiles.y;
    const std::uint64_t pixel_count = std::uint64_t{width} * height;
    // Indirect dispatches over more tiles than one row of workgroups fill up their last row.
    const std::uint64_t rows = divideUp(tile_count, gpu::kTilesFold);
    const std::uint64_t live_capacity = rows > 1 ? rows * gpu::kTilesFold : tile_count;
    device.memory().require(pixel_count * (sizeof(gpu::Hit) + 2 * sizeof(gpu::uint)) + tile_count * sizeof(float) +
                                live_capacity * sizeof(gpu::uvec2),
                            "the picture");
    starts = {device, "tile starts", tile_count};
    live = {device, "live tiles", live_capacity};
    hits = {device, "hits", pixel_count};
    light = {device, "light", pixel_count};
    image = {device, "image", pixel_count};
}

void buildBeam(vk::FrameGraph& graph, const TreeView& tree, BeamGrid& beam)
{
    const Octree& octree = tree.octree();
    if (isEmpty(octree))
    {
        return;
    }
    const std::uint32_t levels = std::min(octree.grid.nodeLevels(), gpu::kBeamLevels);
    const std::uint32_t cells = 1U << (2 * levels);
    const vk::Specialization lists = {tree.entriesPerWord()};
    {
        vk::Pass pass = graph.addPass("trace/beam_mark", lists);
        const gpu::BeamMarkParams params = {pass.read(octree.nodes), pass.write(beam.occupied), levels, cells};
        pass.dispatch(cells * cells, params);
    }
    {
        vk::Pass pass = graph.addPass("trace/beam_dilate");
        const gpu::BeamDilateParams params = {pass.read(beam.occupied), pass.write(beam.rows), cells};
        pass.dispatch(gpu::kBeamRows, params);
    }
    for (const bool level2 : {true, false})
    {
        vk::Pass pass = graph.addPass("trace/beam_nodes", {level2 ? 1U : 0U});
        const gpu::BeamNodesParams params = {pass.read(beam.rows), pass.readWrite(beam.masks),
                                             pass.readWrite(beam.nodes)};
        pass.dispatch(gpu::kBeamGroup * (level2 ? gpu::kBeamGroup : 1), params);
    }
    if (hasFineBeam(octree))
    {
        vk::Pass pass = graph.addPass("trace/beam_refine", lists);
        const gpu::BeamRefineParams params = {pass.read(octree.nodes), pass.read(beam.masks),
                                              pass.readWrite(beam.nodes)};
        pass.dispatch(gpu::kBeamRows * gpu::kBeamGroup, params);
    }
    if (hasPaths(octree))
    {
        vk::Pass pass = graph.addPass("trace/beam_paths", lists);
        const gpu::BeamPathsParams params = {pass.read(octree.nodes), pass.write(beam.paths)};
        pass.dispatch(kPathCellCount, params);
    }
    if (tree.svdag() != nullptr && octree.hasAttributes())
    {
        buildRankTable(graph, tree, beam);
    }
}

void tracePrimary(vk::FrameGraph& graph, const TreeView& tree, const BeamGrid& beam, const TraceCamera& camera,
                  const TraceOptions& options, TraceBuffers& buffers)
{
    const Octree& octree = tree.octree();
    traceBeam(graph, octree, beam, camera, options, buffers);
    const bool count_iterations = options.view == View::Iterations;
    const bool use_paths = options.beam && hasPaths(octree) && !isEmpty(octree) && !options.hasDetail();
    const bool wants_ranks = tree.hasLists() && showsAttributes(options) && usesAttributes(octree, options);
    const bool has_ranks = wants_ranks && !options.hasDetail() && hasRankTable(tree, beam);
    const vk::Specialization constants =
        withFlags(traverseConstants(tree, options),
                  {camera.orthographic, count_iterations, use_paths, use_paths && !standsByLevels(tree),
                   has_ranks && tree.overlaid() != nullptr});
    const std::uint32_t rounds = roundsFor(octree, options);
    // What both kernels take.
    const auto common = [&]<typename Params>(vk::Pass& pass, Params params)
    {
        params.nodes = pass.read(octree.nodes);
        params.paths = use_paths || has_ranks ? pass.read(beam.paths) : gpu::ConstPtr<uint64_t>{};
        params.live = pass.read(buffers.live);
        params.status = pass.readWrite(buffers.status);
        params.hits = pass.readWrite(buffers.hits);
        params.camera = camera.rays;
        params.width = buffers.width;
        params.height = buffers.height;
        return params;
    };
    if (has_ranks)
    {
        const auto declare = [&](vk::Pass& pass)
        {
            auto params = common(pass, gpu::PrimaryRanksParams{});
            const gpu::RankSource source = rankSource(pass, *tree.svdag());
            params.before = source.before;
            if (tree.overlaid() != nullptr)
            {
                pass.read(tree.overlaid()->ranks); // the table has their address
            }
            params.voxels_before_leaf = source.voxels_before_leaf;
            params.first_short_place = source.first_short_place;
            return params;
        };
        addRounds<gpu::PrimaryRanksParams>(graph, "trace/primary_ranks", constants, rounds, buffers.rounds,
                                           buffers.live.count(), declare, dispatchLive(buffers));
        return;
    }
    const auto declare = [&](vk::Pass& pass)
    {
        auto params = common(pass, gpu::PrimaryParams{});
        params.iterations = count_iterations ? pass.readWrite(buffers.light) : gpu::Ptr<gpu::uint>{};
        params.detail = detailOf(options, &camera);
        return params;
    };
    addRounds<gpu::PrimaryParams>(graph, "trace/primary", constants, rounds, buffers.rounds, buffers.live.count(),
                                  declare, dispatchLive(buffers));
    if (wants_ranks)
    {
        rankTiles(graph, tree, options, buffers);
    }
}

void traceLight(vk::FrameGraph& graph, const TreeView& tree, const TraceCamera& camera, const TraceOptions& options,
                TraceBuffers& buffers)
{
    const Octree& octree = tree.octree();
    const vk::Specialization constants =
        withConstants(traverseConstants(tree, options), {camera.orthographic ? 1U : 0U, formToRead(octree, options)});
    if (options.shadows)
    {
        const gpu::vec3 to_sun = sunDirection(options);
        const auto declare = [&](vk::Pass& pass)
        {
            auto params = lightParams<gpu::ShadowParams>(pass, octree, camera, buffers);
            params.light = pass.readWrite(buffers.light);
            params.to_sun = to_sun;
            return params;
        };
        addRounds<gpu::ShadowParams>(graph, "trace/shadow", constants, roundsFor(octree, options), buffers.rounds,
                                     buffers.live.count(), declare, dispatchLive(buffers));
    }
    if (options.occlusion_rays != 0)
    {
        const Grid& grid = octree.grid;
        vk::Pass pass = graph.addPass("trace/occlusion", withFlags(constants, {options.shadows}));
        auto params = lightParams<gpu::OcclusionParams>(pass, octree, camera, buffers);
        params.light = pass.readWrite(buffers.light);
        params.ray_count = std::min(options.occlusion_rays, kOcclusionRaysMax);
        params.radius =
            options.occlusion_reach * static_cast<float>(grid.resolution()) / static_cast<float>(grid.rootResolution());
        pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
    }
}

void shade(vk::FrameGraph& graph, const TreeView& tree, const TraceCamera& camera, const TraceOptions& options,
           TraceBuffers& buffers)
{
    const Octree& octree = tree.octree();
    const gpu::vec3 to_sun = sunDirection(options);
    if (options.view == View::Color)
    {
        vk::Pass pass = graph.addPass("trace/sky", withFlags({}, {camera.orthographic}));
        gpu::SkyParams params{};
        params.image = pass.write(buffers.image);
        params.forward = camera.rays.forward;
        params.step_x = camera.rays.step_x;
        params.step_y = camera.rays.step_y;
        params.to_sun = to_sun;
        params.width = buffers.width;
        params.height = buffers.height;
        params.sun = options.sun;
        params.exposure = options.exposure;
        const std::uint64_t rows = (buffers.height + gpu::kSkyRows - 1) / gpu::kSkyRows;
        pass.dispatch(rows * buffers.width, params);
    }
    else
    {
        graph.fill(buffers.image, kBlack);
    }
    const vk::Specialization constants = withFlags({static_cast<std::uint32_t>(options.view), octree.grid.nodeLevels(),
                                                    camera.orthographic ? 1U : 0U, formToRead(octree, options)},
                                                   {usesAttributes(octree, options) && octree.emission.count() != 0,
                                                    needsLight(options) || options.view == View::Iterations});
    vk::Pass pass = graph.addPass("trace/shade", constants);
    gpu::ShadeParams params{};
    params.live = pass.read(buffers.live);
    params.hits = pass.read(buffers.hits);
    params.light = pass.read(buffers.light);
    readAttributes(pass, octree, params);
    params.emission_words = pass.read(octree.emission_words);
    params.emission = pass.read(octree.emission);
    params.image = pass.readWrite(buffers.image);
    params.forward = camera.rays.forward;
    params.step_x = camera.rays.step_x;
    params.step_y = camera.rays.step_y;
    params.sun = options.view == View::Depth ? gpu::vec3(depthRange(octree.grid, camera), 0.0F) : options.sun * to_sun;
    params.width = buffers.width;
    params.height = buffers.height;
    params.emission_scale = octree.emission_scale;
    params.exposure = options.exposure;
    pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
}

void trace(vk::FrameGraph& graph, const TreeView& tree, const BeamGrid& beam, const TraceCamera& camera,
           const TraceOptions& options, TraceBuffers& buffers)
{
    tracePrimary(graph, tree, beam, camera, options, buffers);
    if (needsLight(options))
    {
        traceLight(graph, tree, camera, options, buffers);
    }
    shade(graph, tree, camera, options, buffers);
}

void traceRays(vk::FrameGraph& graph, const TreeView& tree, const vk::BufferOf<gpu::Ray>& rays,
               vk::BufferOf<gpu::Hit>& hits, vk::BufferOf<gpu::DispatchArgs>& rounds,
               vk::BufferOf<gpu::TraceStatus>& status, const TraceOptions& options)
{
    const Octree& octree = tree.octree();
    if (isEmpty(octree))
    {
        graph.fill(hits, gpu::kHitMiss);
        return;
    }
    const auto declare = [&](vk::Pass& pass)
    {
        gpu::RaysParams params{};
        params.nodes = pass.read(octree.nodes);
        params.rays = pass.read(rays);
        params.hits = pass.readWrite(hits);
        params.status = pass.readWrite(status);
        params.detail = detailOf(options, nullptr);
        params.ray_count = static_cast<std::uint32_t>(rays.count());
        return params;
    };
    const std::uint64_t groups = divideUp(rays.count(), gpu::kRaysGroup);
    addRounds<gpu::RaysParams>(graph, "trace/rays", traverseConstants(tree, options), roundsFor(octree, options),
                               rounds, divideUp(groups, gpu::kTilesFold) * gpu::kTilesFold, declare,
                               [&](vk::Pass& pass, const gpu::RaysParams& params)
                               { pass.dispatch(rays.count(), params); });
    if (tree.svdag() != nullptr && octree.hasAttributes())
    {
        rankHits(graph, tree, options, hits, rays.count());
    }
}

} // namespace zvo
