// SPDX-License-Identifier: MIT
#include "lanes/traced_pictures.h"

#include "core/denoise/denoiser.h"
#include "core/frame/frame_renderer.h"
#include "core/path/path_tracer.h"
#include "core/present/present.h"
#include "core/query/query_list.h"
#include "core/trace/trace.h"
#include "core/trace/trace_depth.h"
#include "core/trace/trace_loads.h"
#include "runtime/trees.h"
#include "support/engine_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace zvo::test
{

void tracePictures(const DeviceTree& tree)
{
    const ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    NodePaths paths(device().device(), tree.isDag());
    TraceBuffers buffers(device().device(), 17, 9);
    run([&](vk::FrameGraph& graph) { buildNodePaths(graph, tree, paths); });
    for (const bool beam : {true, false})
    {
        if (tree.isDag() && !beam)
        {
            continue; // lists and beams are independent, and compiling each variant takes time
        }
        for (const View shown : {View::Color, View::Iterations})
        {
            TraceOptions options;
            options.view = shown;
            options.occlusion_rays = 2;
            options.beam = beam;
            const TraceCamera camera = traceCamera(view, tree.grid, buffers.height);
            run([&](vk::FrameGraph& graph) { trace(graph, tree, paths, camera, options, buffers); });
        }
    }
    TraceOptions coarse;
    coarse.detail_level = 2;
    const TraceCamera camera = traceCamera(view, tree.grid, buffers.height);
    run([&](vk::FrameGraph& graph) { trace(graph, tree, paths, camera, coarse, buffers); });
    const vk::BufferOf<gpu::uint> pixels =
        device().makeBuffer<gpu::uint>("pixels", std::vector<gpu::uint>{4 * buffers.width + 8, 0});
    vk::BufferOf<gpu::PixelReport> reports(device().device(), "reports", pixels.count());
    run([&](vk::FrameGraph& graph) { inspectPixels(graph, tree, camera, coarse, buffers, pixels, reports); });
    const gpu::Ray ray = {{1.1F, 1.2F, 1.3F}, 0.0F, {-1.0F, -2.0F, 3.0F}, 4.0F};
    const vk::BufferOf<gpu::Ray> rays = device().makeBuffer<gpu::Ray>("rays", std::vector<gpu::Ray>(3, ray));
    vk::BufferOf<gpu::Hit> hits(device().device(), "hits", rays.count());
    vk::BufferOf<gpu::DispatchArgs> rounds(device().device(), "rounds", gpu::kTraceRoundsMax);
    vk::BufferOf<gpu::TraceStatus> status(device().device(), "status", 1);
    run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(status, 0);
            traceRays(graph, tree, rays, hits, rounds, status, {});
        });
    RayLoads loads(device().device(), rays.count());
    run([&](vk::FrameGraph& graph) { traceLoads(graph, tree, rays, loads); });
    FrameRenderer samples(device().device());
    samples.resize(buffers.width, buffers.height);
    for (std::uint32_t sample = 0; sample < 2; ++sample)
    {
        run([&](vk::FrameGraph& graph) { samples.addSample(graph, {tree, camera}, {.antialias = true}); });
    }
}

void askQuestions(const DeviceTree& tree)
{
    const std::vector<PointQuery> points = {{{500, 600, 700}}, {{-1, 0, 0}}};
    const std::vector<RayQuery> rays(1);
    const std::vector<BoxQuery> boxes = {{{0, 0, 0}, {5000, 6000, 7000}}};
    const std::vector<NearestQuery> nearest = {{{500, 600, 700}}, {{-900, 0, 0}, 3}};
    const std::vector<SweepQuery> sweeps = {{{0, 0, 0}, {300, 300, 300}, {9000, 8000, 7000}}};
    for (const QueryList& list :
         {QueryList(points), QueryList(rays), QueryList(boxes), QueryList(nearest), QueryList(sweeps)})
    {
        QueryBuffers buffers(device(), list, tree.grid);
        run([&](vk::FrameGraph& graph) { answerQueries(graph, tree, buffers); });
    }
}

void tracePaths(const DeviceTree& tree)
{
    DeviceEnvironment sky(device().device());
    PathTracer tracer(device().device());
    Denoiser denoiser(device().device());
    Developer developer(device().device());
    denoiser.resize(9, 10);
    const ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    const TraceCamera camera = traceCamera(view, tree.grid, 10);
    vk::BufferOf<gpu::uint> picture(device().device(), "picture", 90);
    for (const PathForm form : {PathForm::Stages, PathForm::OneKernel})
    {
        tracer.resize(9, 10, form);
        for (const bool features : {false, true, true})
        {
            tracer.forget();
            run(
                [&](vk::FrameGraph& graph)
                {
                    tracer.addSample(graph, tree, sky, camera, {.bounces = 1, .features = features});
                    if (features)
                    {
                        denoiser.denoise(graph, tracer.guided(), 4);
                    }
                    developer.develop(graph, tracer.picture(), TexelFormat::Rgba8, {}, picture);
                });
        }
    }
}

void keepLight(const DeviceTree& tree)
{
    DeviceEnvironment sky(device().device());
    FrameRenderer tracer(device().device());
    const ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    for (const std::uint32_t height : {10U, 11U})
    {
        tracer.resize(9, height);
        const TraceCamera camera = traceCamera(view, tree.grid, height);
        const FrameOptions options = {.integrator = height == 10 ? Integrator::Cache : Integrator::Cones,
                                      .radiance = {.faces = 100}};
        for (std::uint32_t frame = 0; frame < 2; ++frame)
        {
            run([&](vk::FrameGraph& graph) { tracer.addSample(graph, {tree, camera, &sky}, options); });
        }
    }
}

void tracePacked(BuildResult built, AttributeFormat format)
{
    noteKernels(packTree(device(), format, built.octree));
    EXPECT_EQ(built.octree.attributeFormat(), format);
    tracePictures(built.octree);
}

void traceForHosts(const DeviceTree& tree)
{
    ViewCamera view = ViewCamera::lookAt({25.0, 22.0, 31.0}, {8.0, 8.0, 8.0}, 0.7);
    view.half_height = 12.0;
    const NodePaths paths(device().device(), tree.isDag()); // not used
    ClipDepth clip;                                         // 1 / (1 + distance)
    clip.z.w = 1.0;
    clip.w = glm::dvec4(view.forward, 1.0 - glm::dot(view.forward, view.position));
    clip.miss = 0.0F;
    for (const TexelFormat format : {TexelFormat::Bgra8, TexelFormat::Rgb10, TexelFormat::Half})
    {
        TraceBuffers buffers(device().device(), 17, 9, format);
        vk::BufferOf<float> depth(device().device(), "depth", buffers.hits.count());
        view.orthographic = format == TexelFormat::Half;
        const TraceCamera camera = traceCamera(view, tree.grid, buffers.height);
        for (const View shown : {View::Color, View::Albedo})
        {
            TraceOptions options;
            options.view = shown;
            options.beam = false;
            options.shadows = false;
            run(
                [&](vk::FrameGraph& graph)
                {
                    trace(graph, tree, paths, camera, options, buffers);
                    traceDepth(graph, tree.grid, camera, clip, buffers, depth);
                });
        }
        const std::vector<float> depths = device().download(depth);
        EXPECT_GT(*std::ranges::max_element(depths), 0.0F);
    }
}

void scalePictures()
{
    const std::vector<gpu::uint> from = {1, 2, 3, 4, 5, 6};
    const vk::BufferOf<gpu::uint> small = device().makeBuffer<gpu::uint>("picture", from);
    vk::BufferOf<gpu::uint> wide(device().device(), "wide picture", 12);
    vk::BufferOf<gpu::uint> narrow(device().device(), "narrow picture", 2);
    run(
        [&](vk::FrameGraph& graph)
        {
            scalePicture(graph, small, {3, 2}, wide, {6, 2});
            scalePicture(graph, small, {3, 2}, narrow, {1, 2});
        });
    EXPECT_EQ(device().download(wide), (std::vector<gpu::uint>{1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6}));
    EXPECT_EQ(device().download(narrow), (std::vector<gpu::uint>{2, 5}));
}

} // namespace zvo::test
