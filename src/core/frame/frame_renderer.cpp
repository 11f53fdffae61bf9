// SPDX-License-Identifier: MIT
#include "core/frame/frame_renderer.h"

#include "core/scene/sky.h"

#include <utility>

namespace zvo
{

namespace
{

PathOptions pathOptions(const FrameOptions& options)
{
    PathOptions path = options.path;
    path.smooth = options.shading == Shading::Smooth;
    path.features = path.features || options.denoise;
    path.reseeds = path.reseeds || options.denoise; // earlier pictures help if they have other noise
    return path;
}

CacheView viewOf(const FrameOptions& options)
{
    return options.integrator == Integrator::Cones ? CacheView::Cones
           : options.shading == Shading::Faces     ? CacheView::Faces
                                                   : CacheView::Smooth;
}

// Pictures by primary rays are not metered: the sky says how bright the day is.
float primaryExposure(const FrameOptions& options)
{
    const double daylight = options.exposure.automatic ? daylightExposure(options.trace.to_sun, options.trace.up) : 1.0;
    return options.exposure.factor * static_cast<float>(daylight);
}

bool denoises(const FrameOptions& options)
{
    return options.denoise && options.shownIntegrator() == Integrator::Path;
}

} // namespace

void FrameRenderer::render(vk::FrameGraph& graph, const FrameSubject& subject, const FrameOptions& options,
                           vk::BufferOf<gpu::DispatchArgs>* ray_lists)
{
    if (options.shownIntegrator() != Integrator::Path)
    {
        beginPicture(options);
    }
    addSample(graph, subject, options, ray_lists);
    denoise(graph, options);
    develop(graph, options);
}

void FrameRenderer::addSample(vk::FrameGraph& graph, const FrameSubject& subject, const FrameOptions& options,
                              vk::BufferOf<gpu::DispatchArgs>* ray_lists)
{
    switch (const Integrator integrator = options.shownIntegrator(); integrator)
    {
    case Integrator::Primary:
    {
        TraceOptions trace = options.trace;
        trace.exposure = primaryExposure(options);
        trace.shading = options.shading;
        if (options.hasSamples())
        {
            primaryOfSize().add(graph, m_tracer, subject.tree, subject.camera, trace);
        }
        else
        {
            m_tracer.trace(graph, subject.tree, subject.camera, trace);
        }
        break;
    }
    case Integrator::Path:
        pathsOfSize(options).addSample(graph, subject.tree, *subject.environment, subject.camera, pathOptions(options),
                                       ray_lists);
        break;
    case Integrator::Cache:
    case Integrator::Cones:
    {
        RadianceView& view = viewOfSize();
        const TraceCamera camera = shifted(subject.camera, pointOfPixel(view.frameCount()));
        if (subject.cache == nullptr)
        {
            updateCache(graph, subject, camera, options);
        }
        else
        {
            subject.environment->prepare(graph);
            m_tracer.tracePrimary(graph, subject.tree, camera, {});
        }
        view.add(graph, subject.cache == nullptr ? cache() : *subject.cache, subject.tree, *subject.environment, camera,
                 buffers(), viewOf(options), options.radiance.seed);
        break;
    }
    }
}

void FrameRenderer::denoise(vk::FrameGraph& graph, const FrameOptions& options)
{
    if (denoises(options))
    {
        denoiserOfSize().denoise(graph, m_paths->guided(), options.history_max);
    }
}

void FrameRenderer::develop(vk::FrameGraph& graph, const FrameOptions& options)
{
    if (options.hasSamples())
    {
        const bool is_primary = options.shownIntegrator() == Integrator::Primary;
        const Exposure exposure = is_primary ? Exposure{false, primaryExposure(options)} : options.exposure;
        developer().develop(graph, samples(options), buffers().texels, exposure, m_tracer.image());
    }
}

void FrameRenderer::settle(vk::FrameGraph& graph, const FrameSubject& subject, const FrameOptions& options)
{
    beginPicture(options);
    updateCache(graph, subject, shifted(subject.camera, pointOfPixel(cache().frameCount())), options);
}

// Records the camera's rays, and what they and the faces that they hit bring.
void FrameRenderer::updateCache(vk::FrameGraph& graph, const FrameSubject& subject, const TraceCamera& camera,
                                const FrameOptions& options)
{
    m_tracer.tracePrimary(graph, subject.tree, camera, {});
    cache().update(graph, subject.tree, *subject.environment, camera, buffers(), options.radiance);
}

void FrameRenderer::reserve(const DeviceTree& tree, const FrameOptions& options)
{
    const Integrator integrator = options.shownIntegrator();
    m_tracer.reserve(tree);
    if (integrator == Integrator::Path)
    {
        pathsOfSize(options);
    }
    if (denoises(options))
    {
        denoiserOfSize();
    }
    if (usesCache(integrator))
    {
        viewOfSize();
        cache().reserve(tree, buffers().width, buffers().height, options.radiance);
    }
    if (options.hasSamples())
    {
        if (integrator == Integrator::Primary)
        {
            primaryOfSize();
        }
        developer();
    }
}

PathTracer& FrameRenderer::pathsOfSize(const FrameOptions& options)
{
    if (m_paths == nullptr)
    {
        m_paths = std::make_unique<PathTracer>(m_device, m_deletion_queue);
    }
    m_paths->resize(buffers().width, buffers().height, options.path_form);
    return *m_paths;
}

Denoiser& FrameRenderer::denoiserOfSize()
{
    if (m_denoiser == nullptr)
    {
        m_denoiser = std::make_unique<Denoiser>(m_device, m_deletion_queue);
    }
    m_denoiser->resize(buffers().width, buffers().height);
    return *m_denoiser;
}

RadianceView& FrameRenderer::viewOfSize()
{
    const std::uint32_t width = buffers().width;
    const std::uint32_t height = buffers().height;
    if (m_view == nullptr || m_view->picture().width != width || m_view->picture().height != height)
    {
        vk::replace(m_deletion_queue, m_view, std::make_unique<RadianceView>(m_device, width, height));
    }
    return *m_view;
}

PrimarySamples& FrameRenderer::primaryOfSize()
{
    const std::uint32_t width = buffers().width;
    const std::uint32_t height = buffers().height;
    if (m_primary == nullptr || m_primary->picture().width != width || m_primary->picture().height != height)
    {
        vk::replace(m_deletion_queue, m_primary, std::make_unique<PrimarySamples>(m_device, width, height));
    }
    return *m_primary;
}

DeviceRadianceCache& FrameRenderer::cache()
{
    if (m_cache == nullptr)
    {
        m_cache = std::make_unique<DeviceRadianceCache>(m_device, m_deletion_queue);
    }
    return *m_cache;
}

Developer& FrameRenderer::developer()
{
    if (m_developer == nullptr)
    {
        m_developer = std::make_unique<Developer>(m_device);
    }
    return *m_developer;
}

void FrameRenderer::beginPicture(const FrameOptions& options)
{
    if (usesCache(options.integrator) && m_view != nullptr)
    {
        m_view->begin();
    }
    if (options.integrator == Integrator::Path && m_paths != nullptr)
    {
        m_paths->forget();
    }
    if (options.integrator == Integrator::Primary && m_primary != nullptr)
    {
        m_primary->begin();
    }
}

void FrameRenderer::forgetSamples()
{
    if (m_paths != nullptr)
    {
        m_paths->forget();
    }
    if (m_denoiser != nullptr)
    {
        m_denoiser->forget();
    }
}

void FrameRenderer::dropSamples()
{
    vk::replace(m_deletion_queue, m_paths, {});
    vk::replace(m_deletion_queue, m_denoiser, {});
    vk::replace(m_deletion_queue, m_cache, {});
    vk::replace(m_deletion_queue, m_view, {});
    vk::replace(m_deletion_queue, m_primary, {});
    vk::replace(m_deletion_queue, m_developer, {});
}

SampledPicture FrameRenderer::samples(const FrameOptions& options) const
{
    return usesCache(options.integrator)               ? m_view->picture()
           : options.integrator == Integrator::Primary ? m_primary->picture()
           : denoises(options)                         ? m_denoiser->picture()
                                                       : m_paths->picture();
}

std::uint64_t FrameRenderer::rayListElements(const FrameOptions& options) const
{
    return options.shownIntegrator() == Integrator::Path ? m_paths->listElements(pathOptions(options)) : 0;
}

std::uint64_t FrameRenderer::bytes() const
{
    const auto bytesOf = [](const auto& part) { return part == nullptr ? std::uint64_t{0} : part->bytes(); };
    return buffers().bytes() + bytesOf(m_paths) + bytesOf(m_denoiser) + bytesOf(m_cache) + bytesOf(m_view) +
           bytesOf(m_primary) + bytesOf(m_developer);
}

} // namespace zvo
