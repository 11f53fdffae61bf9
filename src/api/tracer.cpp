// SPDX-License-Identifier: MIT
#include "zvo/tracer.h"

#include "api/camera.h"
#include "api/checked.h"
#include "api/convert.h"
#include "api/environment_impl.h"
#include "api/radiance_cache_impl.h"
#include "api/shown_tree.h"
#include "core/frame/frame_renderer.h"
#include "core/present/image_target.h"
#include "core/trace/trace_depth.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace zvo
{

namespace
{

FrameOptions optionsOf(const TraceInfo& info, const glm::dvec3& up)
{
    FrameOptions options;
    options.trace.up = up;
    options.trace.view = checked(info).view;
    options.trace.shadows = info.shadows;
    options.trace.to_sun = toGlm(info.to_sun);
    options.trace.sun = info.sun;
    options.trace.occlusion_rays = info.occlusion_rays;
    options.trace.occlusion_reach = info.occlusion_reach;
    options.trace.detail_pixels = info.detail_pixels;
    options.shading = info.shading;
    options.exposure = {false, info.exposure};
    return options;
}

FrameOptions optionsOf(const PathInfo& info)
{
    FrameOptions options;
    options.integrator = Integrator::Path;
    options.path.bounces = checked(info).bounces;
    options.path.seed = info.seed;
    options.path.lens_radius = info.lens_radius;
    options.path.focus_distance = info.focus_distance;
    options.path.roulette = info.roulette;
    options.shading = info.shading;
    options.denoise = info.denoise;
    options.history_max = info.history_max;
    options.exposure = {info.automatic_exposure, info.exposure};
    return options;
}

FrameOptions optionsOf(const CachedPictureInfo& info)
{
    FrameOptions options;
    options.integrator = Integrator::Cache;
    options.shading = info.shading;
    options.exposure = {checked(info).automatic_exposure, info.exposure};
    return options;
}

void requireImage(const ImageTarget& target, const char* name)
{
    if (target.image == VK_NULL_HANDLE)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} has no image: it is null", name));
    }
}

} // namespace

struct ZVO_LOCAL Tracer::Impl
{
    Impl(Context::Impl& context_impl, std::uint32_t width, std::uint32_t height, VkFormat format)
        : context(context_impl),
          renderer(std::make_unique<FrameRenderer>(context.device, &context.deletion_queue, texelFormat(format)))
    {
        renderer->resize(checkedEdge(width), checkedEdge(height));
    }

    ~Impl()
    {
        context.deleteLater(std::move(renderer));
        context.deleteLater(std::move(depths));
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    template <typename AnyTree>
    void trace(Recorder& recorder, AnyTree& any_tree, const CameraInfo& camera_info, const TraceInfo& info,
               const ImageTarget& color, const DepthTarget* depth)
    {
        requireSame(context, recorder.impl().context);
        const DeviceTree& tree = shownIn(recorder.impl(), any_tree).tree;
        requireColor(color);
        if (depth != nullptr)
        {
            requireImage(checked(*depth).image, "DepthTarget::image");
            requireDepthCopyable(context.device, size(), depth->image);
        }
        const TraceCamera camera = cameraOf(camera_info, tree);
        const FrameOptions options = optionsOf(info, context.up);
        recording(recorder,
                  [&](Recorder::Impl& impl)
                  {
                      enter(impl);
                      renderer->render(impl.graph, {tree, camera}, options);
                      if (depth != nullptr)
                      {
                          traceDepthOf(impl.graph, tree.grid, camera, *depth);
                      }
                      copyToImage(impl.graph, renderer->buffers(), color);
                      if (depth != nullptr)
                      {
                          copyDepthToImage(impl.graph, depths, size(), depth->image);
                      }
                  });
    }

    template <typename AnyTree>
    void tracePaths(Recorder& recorder, AnyTree& any_tree, Environment& any_environment, const CameraInfo& camera_info,
                    const PathInfo& info, const ImageTarget& color)
    {
        Environment::Impl& environment = usable(any_environment);
        requireSame(context, recorder.impl().context, environment.context);
        const DeviceTree& tree = shownIn(recorder.impl(), any_tree).tree;
        requireColor(color);
        const TraceCamera camera = cameraOf(camera_info, tree);
        const FrameOptions options = optionsOf(info);
        recording(recorder,
                  [&](Recorder::Impl& impl)
                  {
                      if (sample_count == 0 || lostSamples())
                      {
                          renderer->forgetSamples();
                      }
                      path_frame = impl.frame;
                      sample_count = 0; // should anything below throw
                      environment.enter(impl.frame);
                      for (std::uint32_t i = 0; i < info.samples; ++i)
                      {
                          renderer->addSample(impl.graph, {tree, camera, &environment.light}, options);
                      }
                      renderer->denoise(impl.graph, options);
                      renderer->develop(impl.graph, options);
                      copyToImage(impl.graph, renderer->buffers(), color);
                      sample_count = renderer->pathCount();
                  });
    }

    template <typename AnyTree>
    void traceCached(Recorder& recorder, AnyTree& any_tree, Environment& any_environment, RadianceCache& any_light,
                     const CameraInfo& camera_info, const CachedPictureInfo& info, const ImageTarget& color)
    {
        Environment::Impl& environment = usable(any_environment);
        RadianceCache::Impl& light = usable(any_light);
        requireSame(context, recorder.impl().context, environment.context, light.context);
        const DeviceTree& tree = shownIn(recorder.impl(), any_tree).tree;
        requireColor(color);
        const TraceCamera camera = cameraOf(camera_info, tree);
        const FrameOptions options = optionsOf(info);
        light.requireShown(tree);
        recording(
            recorder,
            [&](Recorder::Impl& impl)
            {
                enter(impl);
                environment.enter(impl.frame);
                renderer->render(impl.graph, {tree, camera, &environment.light, &light.renderer->cache()}, options);
                copyToImage(impl.graph, renderer->buffers(), color);
            });
    }

    // Begins a picture of primary rays in a frame.
    void enter(Recorder::Impl& impl)
    {
        if (frame && frame->is_lost)
        {
            renderer->forgetNodePaths();
        }
        frame = impl.frame;
    }

    [[nodiscard]] bool lostSamples() const { return path_frame && path_frame->is_lost; }

    [[nodiscard]] PictureSize size() const { return {renderer->buffers().width, renderer->buffers().height}; }

    [[nodiscard]] TraceCamera cameraOf(const CameraInfo& info, const DeviceTree& tree) const
    {
        return traceCamera(viewOf(info, size()), tree.grid, size().height);
    }

    void requireColor(const ImageTarget& color)
    {
        if (texelFormat(color.format) != renderer->buffers().texels)
        {
            throw Error(ErrorCode::Usage, "this Tracer makes pictures for images of another format: make one with "
                                          "the format of the image");
        }
        requireImage(color, "color");
        requireCopyable(renderer->buffers(), color);
    }

    void traceDepthOf(vk::FrameGraph& graph, const Grid& grid, const TraceCamera& camera, const DepthTarget& target)
    {
        const TraceBuffers& buffers = renderer->buffers();
        if (depths.count() == 0)
        {
            depths = {context.device, "depth", primaryRayCount(buffers)};
        }
        traceDepth(graph, grid, camera, ClipDepth::of(toGlm(target.view_projection), target.miss), buffers, depths);
    }

    Context::Impl& context;
    std::unique_ptr<FrameRenderer> renderer;
    std::shared_ptr<FrameState> frame = nullptr;      // of the last picture of trace() or traceCached()
    std::shared_ptr<FrameState> path_frame = nullptr; // of the last picture of tracePaths()
    std::uint32_t sample_count = 0;                   // of the picture that it has recorded; 0: none
    vk::BufferOf<float> depths = {};                  // empty until depth is requested
};

Tracer::Tracer(Context& context, std::uint32_t width, std::uint32_t height, VkFormat format)
    : m_impl(std::make_unique<Impl>(context.impl(), width, height, format))
{
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

void Tracer::trace(Recorder& recorder, const Tree& tree, const CameraInfo& camera, const TraceInfo& info,
                   const ImageTarget& color, const DepthTarget* depth)
{
    contentOf(m_impl.get(), "tracer").trace(recorder, tree, camera, info, color, depth);
}

void Tracer::trace(Recorder& recorder, DynamicTree& tree, const CameraInfo& camera, const TraceInfo& info,
                   const ImageTarget& color, const DepthTarget* depth)
{
    contentOf(m_impl.get(), "tracer").trace(recorder, tree, camera, info, color, depth);
}

void Tracer::tracePaths(Recorder& recorder, const Tree& tree, Environment& environment, const CameraInfo& camera,
                        const PathInfo& info, const ImageTarget& color)
{
    contentOf(m_impl.get(), "tracer").tracePaths(recorder, tree, environment, camera, info, color);
}

void Tracer::tracePaths(Recorder& recorder, DynamicTree& tree, Environment& environment, const CameraInfo& camera,
                        const PathInfo& info, const ImageTarget& color)
{
    contentOf(m_impl.get(), "tracer").tracePaths(recorder, tree, environment, camera, info, color);
}

void Tracer::traceCached(Recorder& recorder, const Tree& tree, Environment& environment, RadianceCache& light,
                         const CameraInfo& camera, const CachedPictureInfo& info, const ImageTarget& color)
{
    contentOf(m_impl.get(), "tracer").traceCached(recorder, tree, environment, light, camera, info, color);
}

void Tracer::traceCached(Recorder& recorder, DynamicTree& tree, Environment& environment, RadianceCache& light,
                         const CameraInfo& camera, const CachedPictureInfo& info, const ImageTarget& color)
{
    contentOf(m_impl.get(), "tracer").traceCached(recorder, tree, environment, light, camera, info, color);
}

std::uint32_t Tracer::sampleCount() const
{
    const Impl& tracer = contentOf(m_impl.get(), "tracer");
    return tracer.lostSamples() ? 0 : tracer.sample_count;
}

void Tracer::forgetSamples()
{
    Impl& tracer = contentOf(m_impl.get(), "tracer");
    tracer.renderer->forgetSamples();
    tracer.sample_count = 0;
}

} // namespace zvo
