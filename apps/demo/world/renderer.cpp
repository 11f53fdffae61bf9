// SPDX-License-Identifier: MIT
#include "demo/world/renderer.h"

#include <utility>

namespace zvo::demo
{

void Renderer::begin(std::uint64_t frame, const DeviceTree& tree, const Picture& picture, bool encodes_srgb)
{
    m_deletion_queue.beginFrame(frame);
    m_renderer.resize(picture.internal.width, picture.internal.height);
    const Integrator integrator = picture.options.shownIntegrator();
    if (m_options.shownIntegrator() != integrator)
    {
        m_renderer.dropSamples();
    }
    m_options = picture.options;
    m_renderer.reserve(tree, m_options);
    if (m_compose == nullptr || m_compose->size() != picture.window || m_compose->encodesSrgb() != encodes_srgb)
    {
        auto compose = std::make_unique<ComposeImage>(m_device.device(), m_pass, picture.window, encodes_srgb);
        vk::replace(&m_deletion_queue, m_compose, std::move(compose));
    }
}

std::uint64_t Renderer::pictureBytes() const
{
    return m_compose == nullptr ? 0 : m_renderer.bytes() + m_compose->bytes();
}

void Renderer::forget()
{
    m_renderer.forgetNodePaths();
    m_renderer.dropSamples(); // begin() makes what is needed
    m_sky.forgetSun();
}

std::optional<std::uint32_t> Renderer::sampleCount() const
{
    return integrator() == Integrator::Path ? std::optional(m_renderer.pathCount()) : std::nullopt;
}

std::optional<std::uint32_t> Renderer::cacheFrames() const
{
    return usesCache(integrator()) ? std::optional(m_renderer.cacheFrameCount()) : std::nullopt;
}

void Renderer::record(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture)
{
    const TraceBuffers& buffers = m_renderer.buffers();
    const TraceCamera camera = traceCamera(picture.camera, tree.grid, buffers.height);
    const TraceOptions& options = m_options.trace;
    const FrameSubject subject = {tree, camera, &m_sky};
    const double strength = options.shadows ? options.sun : 0.0;
    m_sky.setSun({.direction = options.to_sun, .irradiance = strength * kSunColor});
    if (picture.edited && usesCache(integrator()))
    {
        m_renderer.cache().noteChange();
    }
    m_renderer.render(graph, subject, m_options, picture.ray_lists);
    if (picture.probe != nullptr && integrator() != Integrator::Primary)
    {
        m_renderer.traceHits(graph, subject, m_options);
    }
    if (picture.probe != nullptr)
    {
        picture.probe->record(graph, tree, camera, options, buffers, picture.window);
    }
    m_compose->fill(graph, buffers.image, {buffers.width, buffers.height});
    if (picture.screenshot != nullptr && !picture.screenshot_has_panels)
    {
        m_compose->copyTo(graph, *picture.screenshot);
    }
    if (picture.panels)
    {
        m_compose->drawOver(graph, picture.panels);
    }
    if (picture.screenshot != nullptr && picture.screenshot_has_panels)
    {
        m_compose->copyTo(graph, *picture.screenshot);
    }
    if (picture.target != nullptr)
    {
        m_compose->show(graph, *picture.target);
    }
    if (picture.screenshot != nullptr || picture.probe != nullptr || picture.ray_lists != nullptr)
    {
        graph.releaseToHost();
    }
}

} // namespace zvo::demo
