// SPDX-License-Identifier: MIT
#include "demo/world/renderer.h"

#include "core/scene/camera.h"

#include <utility>

namespace zvo::demo
{

void Renderer::begin(std::uint64_t frame, const DeviceTree& tree, const Picture& picture, bool encodes_srgb)
{
    m_deletion_queue.beginFrame(frame);
    m_tracer.resize(picture.internal.width, picture.internal.height);
    m_tracer.reserve(tree);
    if (m_compose == nullptr || m_compose->size() != picture.window || m_compose->encodesSrgb() != encodes_srgb)
    {
        auto compose = std::make_unique<ComposeImage>(m_device.device(), m_pass, picture.window, encodes_srgb);
        m_deletion_queue.keep(std::exchange(m_compose, std::move(compose)));
    }
}

std::uint64_t Renderer::pictureBytes() const
{
    return m_compose == nullptr ? 0 : m_tracer.buffers().bytes() + m_compose->bytes();
}

void Renderer::record(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture)
{
    const TraceBuffers& buffers = m_tracer.buffers();
    const TraceCamera camera = traceCamera(picture.camera, tree.grid, buffers.height);
    const TraceOptions options = picture.view.traceOptions();
    switch (picture.view.integrator)
    {
    case Integrator::Primary:
        m_tracer.trace(graph, tree, camera, options);
        break;
    }
    if (picture.inspected)
    {
        // The traced pixel that is shown at a pixel (scalePicture()).
        const auto tracedPixel = [](std::uint32_t at, std::uint32_t shown, std::uint32_t traced)
        { return (2 * at + 1) * traced / (2 * shown); };
        const glm::uvec2 pixel = {tracedPixel(picture.inspected->x, picture.window.width, buffers.width),
                                  tracedPixel(picture.inspected->y, picture.window.height, buffers.height)};
        inspectPixel(graph, tree, camera, options, buffers, pixel, *picture.report);
    }
    m_compose->fill(graph, buffers);
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
    if (picture.screenshot != nullptr || picture.inspected)
    {
        graph.releaseToHost();
    }
}

} // namespace zvo::demo
