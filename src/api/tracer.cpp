// SPDX-License-Identifier: MIT
#include "zvo/tracer.h"

#include "api/camera.h"
#include "api/checked.h"
#include "api/convert.h"
#include "api/dynamic_tree_impl.h"
#include "api/environment_impl.h"
#include "api/kept_light_impl.h"
#include "api/tree_impl.h"
#include "core/denoise/denoiser.h"
#include "core/path/path_tracer.h"
#include "core/present/image_target.h"
#include "core/radiance/radiance_view.h"
#include "core/scene/camera.h"
#include "core/trace/trace_depth.h"
#include "core/trace/tree_tracer.h"

#include <fmt/format.h>

#include <optional>

namespace zvo
{

namespace
{

TraceOptions optionsOf(const TraceInfo& info)
{
    TraceOptions options;
    options.view = checked(info).view;
    options.shadows = info.shadows;
    options.to_sun = toGlm(info.to_sun);
    options.sun = info.sun;
    options.exposure = info.exposure;
    options.occlusion_rays = info.occlusion_rays;
    options.occlusion_reach = info.occlusion_reach;
    options.detail_pixels = info.detail_pixels;
    return options;
}

PathOptions pathOptionsOf(const PathInfo& info)
{
    checked(info);
    PathOptions options;
    options.bounces = info.bounces;
    options.seed = info.seed;
    options.lens_radius = info.lens_radius;
    options.focus_distance = info.focus_distance;
    options.roulette = info.roulette;
    options.reseeds = info.denoise; // earlier pictures help if they have other noise
    options.features = info.denoise;
    return options;
}

void requireImage(const ImageTarget& target, const char* name)
{
    if (target.image == VK_NULL_HANDLE)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} has no image: it is null", name));
    }
}

// The samples of tracePaths(), and what makes pictures of them.
struct PathPicture
{
    explicit PathPicture(Context::Impl& context)
        : tracer(context.device, &context.deletion_queue), denoiser(context.device, &context.deletion_queue),
          developer(context.device)
    {
    }

    void forget()
    {
        tracer.forget();
        denoiser.forget();
        sample_count = 0;
    }

    PathTracer tracer;
    Denoiser denoiser;
    Developer developer;
    std::shared_ptr<FrameState> frame = nullptr; // of the last call
    std::uint32_t sample_count = 0;              // of the picture that it has recorded; 0: none
};

// What makes pictures of kept light.
struct KeptPicture
{
    KeptPicture(Context::Impl& context, const TraceBuffers& buffers)
        : view(context.device, buffers.width, buffers.height), developer(context.device)
    {
    }

    RadianceView view;
    Developer developer;
};

} // namespace

struct ZVO_LOCAL Tracer::Impl
{
    Impl(Context::Impl& context_impl, std::uint32_t width, std::uint32_t height, VkFormat format)
        : context(context_impl),
          tracer(std::make_unique<TreeTracer>(context.device, &context.deletion_queue, texelFormat(format)))
    {
        tracer->resize(checkedEdge(width), checkedEdge(height));
    }

    ~Impl()
    {
        context.deleteLater(std::move(tracer));
        context.deleteLater(std::move(depths));
        context.deleteLater(std::move(paths));
        context.deleteLater(std::move(kept));
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void trace(Recorder& recorder, const DeviceTree& tree, const CameraInfo& camera_info, const TraceInfo& info,
               const ImageTarget& color, const DepthTarget* depth)
    {
        const TraceBuffers& buffers = tracer->buffers();
        requireColor(color);
        if (depth != nullptr)
        {
            requireImage(checked(*depth).image, "DepthTarget::image");
            requireDepthCopyable(context.device, {buffers.width, buffers.height}, depth->image);
        }
        const Grid& grid = tree.grid;
        const TraceCamera camera = traceCamera(viewOf(camera_info), grid, buffers.height);
        const TraceOptions options = optionsOf(info);
        recording(recorder,
                  [&](Recorder::Impl& impl)
                  {
                      if (frame && frame->is_lost)
                      {
                          tracer->forget();
                      }
                      frame = impl.frame;
                      tracer->trace(impl.graph, tree, camera, options);
                      if (depth != nullptr)
                      {
                          traceDepthOf(impl.graph, grid, camera, *depth);
                      }
                      copyToImage(impl.graph, buffers, color);
                      if (depth != nullptr)
                      {
                          copyDepthToImage(impl.graph, depths, {buffers.width, buffers.height}, depth->image);
                      }
                  });
    }

    void tracePaths(Recorder& recorder, const DeviceTree& tree, Environment::Impl& environment,
                    const CameraInfo& camera_info, const PathInfo& info, const ImageTarget& color)
    {
        const TraceBuffers& buffers = tracer->buffers();
        requireColor(color);
        const TraceCamera camera = traceCamera(viewOf(camera_info), tree.grid, buffers.height);
        const PathOptions options = pathOptionsOf(info);
        recording(recorder,
                  [&](Recorder::Impl& impl)
                  {
                      makePaths();
                      if (paths->sample_count == 0 || (paths->frame && paths->frame->is_lost))
                      {
                          paths->forget();
                      }
                      paths->frame = impl.frame;
                      paths->sample_count = 0; // should anything below throw
                      environment.enter(impl.frame);
                      for (std::uint32_t i = 0; i < info.samples; ++i)
                      {
                          paths->tracer.addSample(impl.graph, tree, environment.light, camera, options);
                      }
                      if (info.denoise)
                      {
                          paths->denoiser.resize(buffers.width, buffers.height);
                          paths->denoiser.denoise(impl.graph, paths->tracer.guided(), info.history_max);
                      }
                      const SampledPicture shown = info.denoise ? paths->denoiser.picture() : paths->tracer.picture();
                      const Exposure exposure = {info.automatic_exposure, info.exposure};
                      paths->developer.develop(impl.graph, shown, buffers.texels, exposure, tracer->image());
                      copyToImage(impl.graph, buffers, color);
                      paths->sample_count = paths->tracer.sampleCount();
                  });
    }

    void traceKept(Recorder& recorder, const DeviceTree& tree, Environment::Impl& environment, KeptLight::Impl& light,
                   const CameraInfo& camera_info, const KeptPictureInfo& info, const ImageTarget& color)
    {
        const TraceBuffers& buffers = tracer->buffers();
        requireColor(color);
        const TraceCamera camera = traceCamera(viewOf(camera_info), tree.grid, buffers.height);
        const Exposure exposure = {checked(info).automatic_exposure, info.exposure};
        light.requireShown(tree);
        recording(recorder,
                  [&](Recorder::Impl& impl)
                  {
                      if (kept == nullptr)
                      {
                          kept = std::make_unique<KeptPicture>(context, buffers);
                      }
                      if (frame && frame->is_lost)
                      {
                          tracer->forget();
                      }
                      frame = impl.frame;
                      environment.enter(impl.frame);
                      environment.light.prepare(impl.graph);
                      tracer->tracePrimary(impl.graph, tree, camera, {});
                      kept->view.begin();
                      kept->view.add(impl.graph, *light.cache, tree, environment.light, camera, buffers);
                      kept->developer.develop(impl.graph, kept->view.picture(), buffers.texels, exposure,
                                              tracer->image());
                      copyToImage(impl.graph, buffers, color);
                  });
    }

    void makePaths()
    {
        if (paths == nullptr)
        {
            auto made = std::make_unique<PathPicture>(context);
            made->tracer.resize(tracer->buffers().width, tracer->buffers().height);
            paths = std::move(made);
        }
    }

    void requireColor(const ImageTarget& color)
    {
        if (texelFormat(color.format) != tracer->buffers().texels)
        {
            throw Error(ErrorCode::Usage, "this Tracer makes pictures for images of another format: make one with "
                                          "the format of the image");
        }
        requireImage(color, "color");
        requireCopyable(tracer->buffers(), color);
    }

    void traceDepthOf(vk::FrameGraph& graph, const Grid& grid, const TraceCamera& camera, const DepthTarget& target)
    {
        const TraceBuffers& buffers = tracer->buffers();
        if (depths.count() == 0)
        {
            depths = {context.device, "depth", primaryRayCount(buffers)};
        }
        traceDepth(graph, grid, camera, ClipDepth::of(toGlm(target.view_projection), target.miss), buffers, depths);
    }

    Context::Impl& context;
    std::unique_ptr<TreeTracer> tracer;
    std::shared_ptr<FrameState> frame = nullptr;  // of the last picture of trace() or traceKept()
    vk::BufferOf<float> depths = {};              // empty until depth is requested
    std::unique_ptr<PathPicture> paths = nullptr; // null until paths are requested
    std::unique_ptr<KeptPicture> kept = nullptr;  // likewise of kept light
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
    Impl& tracer = contentOf(m_impl.get(), "tracer");
    const Tree::Impl& impl = usable(tree);
    requireSame(tracer.context, impl.context);
    requireSame(tracer.context, recorder.impl().context);
    tracer.trace(recorder, impl.fixed, camera, info, color, depth);
}

void Tracer::trace(Recorder& recorder, DynamicTree& tree, const CameraInfo& camera, const TraceInfo& info,
                   const ImageTarget& color, const DepthTarget* depth)
{
    Impl& tracer = contentOf(m_impl.get(), "tracer");
    DynamicTree::Impl& impl = usable(tree);
    requireSame(tracer.context, impl.context);
    impl.enter(recorder.impl());
    tracer.trace(recorder, impl.octree->tree(), camera, info, color, depth);
}

void Tracer::tracePaths(Recorder& recorder, const Tree& tree, Environment& environment, const CameraInfo& camera,
                        const PathInfo& info, const ImageTarget& color)
{
    Impl& tracer = contentOf(m_impl.get(), "tracer");
    const Tree::Impl& impl = usable(tree);
    Environment::Impl& light = usable(environment);
    requireSame(tracer.context, impl.context);
    requireSame(tracer.context, light.context);
    requireSame(tracer.context, recorder.impl().context);
    tracer.tracePaths(recorder, impl.fixed, light, camera, info, color);
}

void Tracer::tracePaths(Recorder& recorder, DynamicTree& tree, Environment& environment, const CameraInfo& camera,
                        const PathInfo& info, const ImageTarget& color)
{
    Impl& tracer = contentOf(m_impl.get(), "tracer");
    DynamicTree::Impl& impl = usable(tree);
    Environment::Impl& light = usable(environment);
    requireSame(tracer.context, impl.context);
    requireSame(tracer.context, light.context);
    impl.enter(recorder.impl());
    tracer.tracePaths(recorder, impl.octree->tree(), light, camera, info, color);
}

void Tracer::traceKept(Recorder& recorder, const Tree& tree, Environment& environment, KeptLight& light,
                       const CameraInfo& camera, const KeptPictureInfo& info, const ImageTarget& color)
{
    Impl& tracer = contentOf(m_impl.get(), "tracer");
    const Tree::Impl& impl = usable(tree);
    Environment::Impl& outside = usable(environment);
    KeptLight::Impl& kept = usable(light);
    requireSame(tracer.context, impl.context);
    requireSame(tracer.context, outside.context);
    requireSame(tracer.context, kept.context);
    requireSame(tracer.context, recorder.impl().context);
    tracer.traceKept(recorder, impl.fixed, outside, kept, camera, info, color);
}

void Tracer::traceKept(Recorder& recorder, DynamicTree& tree, Environment& environment, KeptLight& light,
                       const CameraInfo& camera, const KeptPictureInfo& info, const ImageTarget& color)
{
    Impl& tracer = contentOf(m_impl.get(), "tracer");
    DynamicTree::Impl& impl = usable(tree);
    Environment::Impl& outside = usable(environment);
    KeptLight::Impl& kept = usable(light);
    requireSame(tracer.context, impl.context);
    requireSame(tracer.context, outside.context);
    requireSame(tracer.context, kept.context);
    impl.enter(recorder.impl());
    tracer.traceKept(recorder, impl.octree->tree(), outside, kept, camera, info, color);
}

std::uint32_t Tracer::sampleCount() const
{
    const PathPicture* const paths = contentOf(m_impl.get(), "tracer").paths.get();
    return paths == nullptr || (paths->frame && paths->frame->is_lost) ? 0 : paths->sample_count;
}

void Tracer::forgetSamples()
{
    if (PathPicture* const paths = contentOf(m_impl.get(), "tracer").paths.get())
    {
        paths->forget();
    }
}

} // namespace zvo
