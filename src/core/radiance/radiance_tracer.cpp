// SPDX-License-Identifier: MIT
#include "core/radiance/radiance_tracer.h"

#include <utility>

namespace zvo
{

void RadianceTracer::resize(std::uint32_t width, std::uint32_t height)
{
    if (m_view != nullptr && m_tracer.buffers().width == width && m_tracer.buffers().height == height)
    {
        return;
    }
    auto view = std::make_unique<RadianceView>(m_device, width, height);
    m_tracer.resize(width, height);
    vk::replace(m_deletion_queue, m_view, std::move(view));
}

void RadianceTracer::reserve(const DeviceTree& tree, const RadianceOptions& options)
{
    m_tracer.reserve(tree);
    m_cache.reserve(tree, m_tracer.buffers().width, m_tracer.buffers().height, options);
}

void RadianceTracer::forget()
{
    m_tracer.forget();
    m_cache.forget();
    beginPicture();
}

// Records the camera's rays, and what they and the faces that they hit bring.
void RadianceTracer::update(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                            const TraceCamera& camera, const RadianceOptions& options)
{
    m_tracer.tracePrimary(graph, tree, camera, {});
    m_cache.update(graph, tree, environment, camera, m_tracer.buffers(), options);
}

void RadianceTracer::addFrame(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                              const TraceCamera& camera, const RadianceOptions& options, KeptView kind)
{
    const TraceCamera through = shifted(camera, pointOfPixel(m_view->frameCount()));
    update(graph, tree, environment, through, options);
    m_view->add(graph, m_cache, tree, environment, through, m_tracer.buffers(), kind, options.seed);
}

void RadianceTracer::settle(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                            const TraceCamera& camera, const RadianceOptions& options)
{
    beginPicture();
    update(graph, tree, environment, shifted(camera, pointOfPixel(m_cache.frameCount())), options);
}

} // namespace zvo
