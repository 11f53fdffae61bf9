// SPDX-License-Identifier: MIT
#include "core/radiance/radiance_tracer.h"

#include <cmath>
#include <utility>

namespace zvo
{

glm::vec2 pointOfPixel(std::uint32_t frame)
{
    constexpr glm::dvec2 kSteps = {0.7548776662466927, 0.5698402909980532};
    const glm::dvec2 point = glm::fract(0.5 + static_cast<double>(frame) * kSteps) - 0.5;
    return point;
}

void RadianceTracer::resize(std::uint32_t width, std::uint32_t height)
{
    if (m_sums != nullptr && m_tracer.buffers().width == width && m_tracer.buffers().height == height)
    {
        return;
    }
    auto sums = std::make_unique<vk::BufferOf<gpu::PixelSum>>(m_device, "radiance/sums", std::uint64_t{width} * height);
    m_tracer.resize(width, height);
    vk::replace(m_deletion_queue, m_sums, std::move(sums));
    beginPicture();
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
    TraceOptions trace;
    trace.stack = options.stack;
    m_tracer.tracePrimary(graph, tree, camera, trace);
    m_cache.update(graph, tree, environment, camera, m_tracer.buffers(), options);
}

void RadianceTracer::addFrame(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                              const TraceCamera& camera, const RadianceOptions& options)
{
    const std::uint32_t frame = std::exchange(m_frame_count, 0); // should anything below throw
    const TraceCamera through = shifted(camera, pointOfPixel(frame));
    update(graph, tree, environment, through, options);
    m_cache.view(graph, tree, environment, through, m_tracer.buffers(), *m_sums, frame == 0, options);
    m_frame_count = frame + 1;
}

void RadianceTracer::settle(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                            const TraceCamera& camera, const RadianceOptions& options)
{
    beginPicture();
    update(graph, tree, environment, shifted(camera, pointOfPixel(m_cache.frameCount())), options);
}

} // namespace zvo
