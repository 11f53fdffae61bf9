// SPDX-License-Identifier: MIT
#include "demo/world/renderer.h"

#include "core/path/daylight.h"
#include "core/path/develop.h"
#include "zvo/error.h"

#include <utility>

namespace zvo::demo
{

void Renderer::beginFrame(std::uint64_t frame, const Composition& composition)
{
    m_deletion_queue.beginFrame(frame);
    if (m_compose == nullptr || m_compose->size() != composition.window ||
        m_compose->encodesSrgb() != composition.encodes_srgb)
    {
        auto compose =
            std::make_unique<ComposeImage>(m_device.device(), m_pass, composition.window, composition.encodes_srgb);
        vk::replace(&m_deletion_queue, m_compose, std::move(compose));
    }
}

void Renderer::reserve(const DeviceTree& tree, const Picture& picture)
{
    m_renderer.resize(picture.size.width, picture.size.height);
    m_has_buffers = true;
    if (m_options.shownIntegrator() != picture.options.shownIntegrator())
    {
        m_renderer.dropSamples();
    }
    m_has_hits = false;
    m_renderer.reserve(tree, picture.options);
    m_options = picture.options;
}

std::uint64_t Renderer::pictureBytes() const
{
    return (m_has_buffers ? m_renderer.bytes() : 0) + (m_compose == nullptr ? 0 : m_compose->bytes()) + m_kept.bytes();
}

void Renderer::forget()
{
    m_renderer.forgetNodePaths();
    m_renderer.dropSamples(); // reserve() makes what is needed
    m_sky.forgetSun();
}

void Renderer::beginPicture()
{
    if (integrator() != Integrator::Path)
    {
        m_renderer.beginPicture(m_options);
        m_sample_count = 0;
    }
}

std::optional<std::uint32_t> Renderer::cacheFrames() const
{
    return usesCache(integrator()) ? std::optional(m_renderer.cacheFrameCount()) : std::nullopt;
}

// What samples see. camera: must stay.
FrameSubject Renderer::begin(const DeviceTree& tree, const TraceCamera& camera, const Picture& picture)
{
    const TraceOptions& options = m_options.trace;
    Sun sun = daylight(options.to_sun);
    sun.irradiance *= picture.has_sun ? 1.0 : 0.0;
    m_sky.setSun(sun);
    if (picture.edited && usesCache(integrator()))
    {
        m_renderer.cache().noteChange();
    }
    return {tree, camera, &m_sky};
}

void Renderer::recordPicture(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture)
{
    const TraceCamera camera = traceCamera(picture.camera, tree.grid, picture.size.height);
    const FrameSubject subject = begin(tree, camera, picture);
    m_renderer.render(graph, subject, m_options, picture.ray_lists);
    m_sample_count = integrator() == Integrator::Path ? m_renderer.pathCount() : 1;
    m_has_hits = integrator() != Integrator::Path; // whose rays leave no hits in buffers()
    probe(graph, subject, picture);
}

void Renderer::recordSample(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture)
{
    const TraceCamera camera = traceCamera(picture.camera, tree.grid, picture.size.height);
    const FrameSubject subject = begin(tree, camera, picture);
    m_renderer.addSample(graph, subject, m_options, picture.ray_lists);
    m_sample_count = m_options.hasSamples() ? m_renderer.samples(m_options).sample_count : 1;
    m_has_hits = m_has_hits || integrator() != Integrator::Path;
    recordDevelopment(graph, m_options);
    probe(graph, subject, picture);
}

void Renderer::recordDevelopment(vk::FrameGraph& graph, const FrameOptions& options)
{
    m_options = options;
    m_renderer.denoise(graph, m_options);
    m_renderer.develop(graph, m_options);
}

PictureSize Renderer::pictureSize() const
{
    return {m_renderer.buffers().width, m_renderer.buffers().height};
}

std::vector<gpu::uint> Renderer::pixels() const
{
    return m_device.download(m_renderer.buffers().image);
}

HdrImage Renderer::radiance() const
{
    if (!m_options.hasSamples())
    {
        throw Error(ErrorCode::Usage, "this picture holds no radiance: let a lit picture stand still, or name it .png");
    }
    const SampledPicture picture = m_renderer.samples(m_options);
    return pictureOf(m_device.download(picture.sums), picture.width, picture.height, picture.sample_count);
}

void Renderer::recordProbe(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture)
{
    const TraceCamera camera = traceCamera(picture.camera, tree.grid, picture.size.height);
    probe(graph, begin(tree, camera, picture), picture);
}

void Renderer::probe(vk::FrameGraph& graph, const FrameSubject& subject, const Picture& picture)
{
    if (picture.probe == nullptr)
    {
        return;
    }
    if (!std::exchange(m_has_hits, true))
    {
        m_renderer.traceHits(graph, subject, m_options);
    }
    picture.probe->record(graph, subject.tree, subject.camera,
                          usesCache(integrator()) ? TraceOptions() : m_options.trace, m_renderer.buffers(),
                          picture.window);
}

void Renderer::makeKept(PictureSize size)
{
    if (m_kept.count() == 0 || m_kept_size != size)
    {
        vk::BufferOf<gpu::uint> kept(m_device.device(), "kept picture", std::uint64_t{size.width} * size.height);
        m_deletion_queue.keep(std::exchange(m_kept, std::move(kept)));
        m_kept_size = size;
    }
    m_shows_kept = true;
}

void Renderer::keepPicture(vk::FrameGraph& graph)
{
    const TraceBuffers& buffers = m_renderer.buffers();
    makeKept({buffers.width, buffers.height});
    graph.copy(buffers.image, 0, m_kept, 0, m_kept.bytes());
}

void Renderer::keepColor(vk::FrameGraph& graph, gpu::uint color)
{
    makeKept({1, 1});
    graph.fill(m_kept, color);
}

void Renderer::recordFrame(vk::FrameGraph& graph, const Composition& composition)
{
    if (m_shows_kept)
    {
        m_compose->fill(graph, m_kept, m_kept_size);
    }
    else
    {
        const TraceBuffers& buffers = m_renderer.buffers();
        m_compose->fill(graph, buffers.image, {buffers.width, buffers.height});
    }
    if (composition.screenshot != nullptr && !composition.screenshot_has_panels)
    {
        m_compose->copyTo(graph, *composition.screenshot);
    }
    if (composition.panels)
    {
        m_compose->drawOver(graph, composition.panels);
    }
    if (composition.screenshot != nullptr && composition.screenshot_has_panels)
    {
        m_compose->copyTo(graph, *composition.screenshot);
    }
    if (composition.target != nullptr)
    {
        m_compose->show(graph, *composition.target);
    }
}

} // namespace zvo::demo
