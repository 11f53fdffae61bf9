// SPDX-License-Identifier: MIT
// Light at hits, and colours from hits and light.
#include "core/scene/sky.h"
#include "core/trace/trace_passes.h"
#include "core/trace/trace_paths.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace zvo
{

namespace
{

gpu::vec3 sunDirection(const TraceOptions& options)
{
    const double length = glm::length(options.to_sun);
    return length > 0.0 ? gpu::vec3(options.to_sun / length) : gpu::vec3(options.up);
}

// Records the pass that fills the picture with what rays see that hit nothing.
void drawBackground(vk::FrameGraph& graph, const TraceCamera& camera, const TraceOptions& options,
                    const TraceBuffers& buffers, const TexelTarget& target)
{
    const bool shows_sky = options.view == View::Color;
    if (!shows_sky && target.format != TexelFormat::Half) // black is one word
    {
        graph.fill(target.texels, target.format == TexelFormat::Rgb10 ? 3U << 30 : 255U << 24);
        return;
    }
    vk::Pass pass = graph.addPass(
        gpu::trace::Sky{.orthographic = camera.orthographic, .texels = target.format, .black = !shows_sky});
    gpu::SkyParams params{};
    params.sky = pass.read(buffers.sky);
    params.image = pass.write(target.texels);
    params.forward = camera.rays.forward;
    params.half_pixel_x = camera.rays.half_pixel_x;
    params.half_pixel_y = camera.rays.half_pixel_y;
    params.width = buffers.width;
    params.height = buffers.height;
    params.sun = options.sun;
    params.exposure = options.exposure;
    const std::uint64_t rows = divideUp(buffers.height, gpu::kSkyRows);
    pass.dispatch(rows * buffers.width, params);
}

// Least and greatest depth of the grid in front of the camera, in unit space.
gpu::vec2 depthRange(const Grid& grid, const TraceCamera& camera)
{
    const float edge = static_cast<float>(grid.resolution()) / static_cast<float>(grid.rootResolution());
    const gpu::vec3& axis = camera.axis;
    const float middle = glm::dot(gpu::vec3(1.0F + 0.5F * edge) - camera.rays.origin, axis);
    const float reach = 0.5F * edge * (std::fabs(axis.x) + std::fabs(axis.y) + std::fabs(axis.z));
    return {std::max(middle - reach, 0.0F), std::max(middle + reach, 1e-6F)};
}

// The parameters that all passes share which trace rays from hits.
template <typename Params>
Params lightParams(vk::AnyPass& pass, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
                   const TraceOptions& options, TraceBuffers& buffers)
{
    Params params{};
    params.nodes = pass.read(tree.nodes);
    params.live = pass.read(buffers.live);
    params.hits = pass.read(buffers.hits);
    readAttributes(pass, tree, params);
    params.paths = usesPaths(tree, options) ? pass.read(paths.cells) : gpu::ConstPtr<uint64_t>{};
    params.status = pass.readWrite(buffers.status);
    params.forward = camera.rays.forward;
    params.half_pixel_x = camera.rays.half_pixel_x;
    params.half_pixel_y = camera.rays.half_pixel_y;
    params.width = buffers.width;
    params.height = buffers.height;
    return params;
}

// The parameters that both kernels share which give hits their colours.
template <typename Params>
Params shadeParams(vk::AnyPass& pass, const DeviceTree& tree, const TraceCamera& camera, const TraceBuffers& buffers,
                   const TexelTarget& target)
{
    Params params{};
    params.live = pass.read(buffers.live);
    params.hits = pass.read(buffers.hits);
    readAttributes(pass, tree, params);
    params.image = pass.readWrite(target.texels);
    params.forward = camera.rays.forward;
    params.half_pixel_x = camera.rays.half_pixel_x;
    params.half_pixel_y = camera.rays.half_pixel_y;
    params.width = buffers.width;
    params.height = buffers.height;
    return params;
}

void shadeLit(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
              const TraceBuffers& buffers, const TexelTarget& target)
{
    vk::Pass pass =
        graph.addPass(gpu::trace::Shade{.node_levels = tree.grid.nodeLevels(),
                                        .orthographic = camera.orthographic,
                                        .format = formatToRead(tree, options),
                                        .emission = usesAttributes(tree, options) && tree.emission.count() != 0,
                                        .light = needsLight(options),
                                        .texels = target.format,
                                        .smooth_normals = options.shading == Shading::Smooth});
    auto params = shadeParams<gpu::ShadeParams>(pass, tree, camera, buffers, target);
    params.light = pass.read(buffers.light);
    params.emission_words = pass.read(tree.emission_words);
    params.emission = pass.read(tree.emission);
    params.sky = pass.read(buffers.sky);
    params.sun = options.sun;
    params.emission_scale = tree.emission_scale;
    params.exposure = options.exposure;
    pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
}

void shadeView(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
               const TraceBuffers& buffers, const TexelTarget& target)
{
    vk::Pass pass = graph.addPass(gpu::trace::Views{.view = options.view,
                                                    .node_levels = tree.grid.nodeLevels(),
                                                    .orthographic = camera.orthographic,
                                                    .format = formatToRead(tree, options),
                                                    .texels = target.format});
    auto params = shadeParams<gpu::ViewsParams>(pass, tree, camera, buffers, target);
    params.iterations = pass.read(buffers.light);
    params.depth_range = depthRange(tree.grid, camera);
    params.first_changed_voxel = tree.voxel_count;
    // The static root's attribute is behind those of the static nodes (DeviceTree::node_attributes).
    params.first_changed_node = 1 + tree.octreeNodeCount();
    pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
}

} // namespace

void traceLight(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
                const TraceOptions& options, TraceBuffers& buffers)
{
    const AttributeFormat format = formatToRead(tree, options);
    if (options.shadows)
    {
        const gpu::trace::Shadow kernel{.orthographic = camera.orthographic,
                                        .format = format,
                                        .smooth_normals = options.shading == Shading::Smooth};
        const gpu::vec3 to_sun = sunDirection(options);
        const auto declare = [&](vk::AnyPass& pass)
        {
            auto params = lightParams<gpu::ShadowParams>(pass, tree, paths, camera, options, buffers);
            params.light = pass.readWrite(buffers.light);
            params.to_sun = to_sun;
            return params;
        };
        addRounds(graph, beginningOnPaths(traversing(kernel, tree, options), tree, options), roundsFor(tree, options),
                  buffers.rounds, buffers.live.count(), declare, dispatchLive(buffers));
    }
    if (options.occlusion_rays != 0)
    {
        const Grid& grid = tree.grid;
        const gpu::trace::Occlusion kernel{.orthographic = camera.orthographic,
                                           .format = format,
                                           .shadows = options.shadows,
                                           .smooth_normals = options.shading == Shading::Smooth};
        vk::Pass pass = graph.addPass(beginningOnPaths(traversing(kernel, tree, options), tree, options));
        auto params = lightParams<gpu::OcclusionParams>(pass, tree, paths, camera, options, buffers);
        params.light = pass.readWrite(buffers.light);
        params.ray_count = std::min(options.occlusion_rays, kOcclusionRaysMax);
        params.turn = options.occlusion_turn;
        params.radius =
            options.occlusion_reach * static_cast<float>(grid.resolution()) / static_cast<float>(grid.rootResolution());
        pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
    }
}

void shade(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
           TraceBuffers& buffers, const TexelTarget& target)
{
    graph.update(buffers.sky, 0, std::array{skyOf(options.to_sun, options.up)});
    drawBackground(graph, camera, options, buffers, target);
    if (options.view == View::Color)
    {
        shadeLit(graph, tree, camera, options, buffers, target);
    }
    else
    {
        shadeView(graph, tree, camera, options, buffers, target);
    }
}

} // namespace zvo
