// SPDX-License-Identifier: MIT
#include "core/trace/trace.h"

#include "core/base/divide_up.h"
#include "core/trace/trace_beam.h"
#include "core/trace/trace_passes.h"
#include "core/trace/trace_paths.h"
#include "core/trace/trace_ranks.h"
#include "vk/device.h"

namespace zvo
{

static_assert(static_cast<gpu::uint>(View::Color) == gpu::kViewColor);
static_assert(static_cast<gpu::uint>(View::Albedo) == gpu::kViewAlbedo);
static_assert(static_cast<gpu::uint>(View::Normal) == gpu::kViewNormal);
static_assert(static_cast<gpu::uint>(View::Depth) == gpu::kViewDepth);
static_assert(static_cast<gpu::uint>(View::Level) == gpu::kViewLevel);
static_assert(static_cast<gpu::uint>(View::Iterations) == gpu::kViewIterations);
static_assert(static_cast<gpu::uint>(View::Voxel) == gpu::kViewVoxel);
static_assert(static_cast<gpu::uint>(View::Bricks) == gpu::kViewBricks);
static_assert(static_cast<gpu::uint>(View::Origin) == gpu::kViewOrigin);

TraceBuffers::TraceBuffers(vk::Device& device, std::uint32_t picture_width, std::uint32_t picture_height,
                           TexelFormat picture_texels)
    : width(picture_width), height(picture_height), texels(picture_texels), args(device, "trace args", 1),
      rounds(device, "trace rounds", gpu::kTraceRoundsMax), status(device, "trace status", 1), sky(device, "sky", 1)
{
    const PictureTiles tiles(*this);
    const std::uint64_t tile_count = tiles.x * tiles.y;
    const std::uint64_t pixel_count = std::uint64_t{width} * height;
    // Indirect dispatches over more tiles than one row of workgroups fill up their last row.
    const std::uint64_t rows = divideUp(tile_count, gpu::kTilesFold);
    const std::uint64_t live_capacity = rows > 1 ? rows * gpu::kTilesFold : tile_count;
    device.memory().require(pixel_count * (sizeof(gpu::Hit) + (1 + texelWords(texels)) * sizeof(gpu::uint)) +
                                tile_count * sizeof(float) + live_capacity * sizeof(gpu::uvec2),
                            "the picture");
    starts = {device, "tile starts", tile_count};
    live = {device, "live tiles", live_capacity};
    hits = {device, "hits", pixel_count};
    light = {device, "light", pixel_count};
    image = {device, "image", pixel_count * texelWords(texels)};
}

std::uint64_t TraceBuffers::bytes() const
{
    // Every member has a name here, or this does not compile: none is forgotten.
    const auto& [own_width, own_height, own_texels, starts_, live_, args_, rounds_, status_, sky_, hits_, light_,
                 image_] = *this;
    return starts_.bytes() + live_.bytes() + args_.bytes() + rounds_.bytes() + status_.bytes() + sky_.bytes() +
           hits_.bytes() + light_.bytes() + image_.bytes();
}

void tracePrimary(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
                  const TraceOptions& options, TraceBuffers& buffers)
{
    traceBeam(graph, tree, camera, options, buffers);
    const bool count_iterations = options.view == View::Iterations;
    const bool use_paths = usesPaths(tree, options);
    const bool wants_ranks = tree.isDag() && showsAttributes(options) && usesAttributes(tree, options);
    const bool has_ranks = options.beam && wants_ranks && !options.hasDetail() && hasRankTable(tree, paths);
    const auto primary = [&]<typename Kernel>(Kernel kernel)
    {
        kernel = beginningOnPaths(traversing(kernel, tree, options), tree, options);
        kernel.orthographic = camera.orthographic;
        kernel.count_iterations = count_iterations;
        kernel.overlays = has_ranks && tree.hasOverlays();
        return kernel;
    };
    const std::uint32_t rounds = roundsFor(tree, options);
    // What both kernels take.
    const auto common = [&]<typename Params>(vk::AnyPass& pass, Params params)
    {
        params.nodes = pass.read(tree.nodes);
        params.paths = use_paths || has_ranks ? pass.read(paths.cells) : gpu::ConstPtr<uint64_t>{};
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
        const auto declare = [&](vk::AnyPass& pass)
        {
            auto params = common(pass, gpu::PrimaryRanksParams{});
            readRankSource(pass, tree, params);
            if (tree.hasOverlays())
            {
                pass.read(tree.overlays.ranks); // the table has their address
            }
            return params;
        };
        addRounds(graph, primary(gpu::trace::PrimaryRanks{}), rounds, buffers.rounds, buffers.live.count(), declare,
                  dispatchLive(buffers));
        return;
    }
    const auto declare = [&](vk::AnyPass& pass)
    {
        auto params = common(pass, gpu::PrimaryParams{});
        params.leaf_groups = pass.read(tree.leaf_groups);
        params.iterations = count_iterations ? pass.readWrite(buffers.light) : gpu::Ptr<gpu::uint>{};
        params.detail = detailOf(options, &camera);
        return params;
    };
    addRounds(graph, primary(gpu::trace::Primary{}), rounds, buffers.rounds, buffers.live.count(), declare,
              dispatchLive(buffers));
    if (wants_ranks)
    {
        rankTiles(graph, tree, options, buffers);
    }
}

void trace(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
           const TraceOptions& options, TraceBuffers& buffers)
{
    traceTo(graph, tree, paths, camera, options, buffers, {buffers.image, buffers.texels});
}

void traceTo(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
             const TraceOptions& options, TraceBuffers& buffers, const TexelTarget& target)
{
    tracePrimary(graph, tree, paths, camera, options, buffers);
    if (needsLight(options))
    {
        traceLight(graph, tree, paths, camera, options, buffers);
    }
    shade(graph, tree, camera, options, buffers, target);
}

void traceRays(vk::FrameGraph& graph, const DeviceTree& tree, const vk::BufferOf<gpu::Ray>& rays,
               vk::BufferOf<gpu::Hit>& hits, vk::BufferOf<gpu::DispatchArgs>& rounds,
               vk::BufferOf<gpu::TraceStatus>& status, const TraceOptions& options, const RayListLength* length)
{
    if (isEmpty(tree))
    {
        graph.fill(hits, gpu::kHitMiss);
        return;
    }
    const auto declare = [&](vk::AnyPass& pass)
    {
        gpu::RaysParams params{};
        params.nodes = pass.read(tree.nodes);
        params.leaf_groups = pass.read(tree.leaf_groups);
        params.rays = pass.read(rays);
        params.hits = pass.readWrite(hits);
        params.status = pass.readWrite(status);
        params.detail = detailOf(options, nullptr);
        params.ray_count = static_cast<std::uint32_t>(rays.count());
        params.list_length = readLength(pass, length);
        return params;
    };
    const std::uint64_t groups = divideUp(rays.count(), gpu::kRaysGroup);
    const gpu::trace::Rays kernel{.counted = length != nullptr};
    addRounds(graph, traversing(kernel, tree, options), roundsFor(tree, options), rounds,
              divideUp(groups, gpu::kTilesFold) * gpu::kTilesFold, declare,
              [&](auto& pass, const gpu::RaysParams& params) { dispatchList(pass, params, rays.count(), length); });
    if (tree.isDag() && tree.hasAttributes())
    {
        rankHits(graph, tree, options, hits, rays.count(), length);
    }
}

} // namespace zvo
