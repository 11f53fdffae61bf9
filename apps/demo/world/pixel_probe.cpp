// SPDX-License-Identifier: MIT
#include "demo/world/pixel_probe.h"

#include <utility>

namespace zvo::demo
{

PixelProbe::PixelProbe(vk::Device& device, std::vector<glm::uvec2> pixels)
    : m_pixels(std::move(pixels)), m_traced(device, "inspected pixels", m_pixels.size(), vk::MemoryKind::Upload),
      m_reports(device, "pixel reports", m_pixels.size(), vk::MemoryKind::Readback)
{
}

void PixelProbe::record(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                        const TraceOptions& options, const TraceBuffers& buffers, PictureSize window)
{
    // The traced pixel that is shown at a pixel (scalePicture()).
    const auto tracedPixel = [](std::uint32_t at, std::uint32_t shown, std::uint32_t traced)
    { return (2 * at + 1) * traced / (2 * shown); };
    for (std::size_t i = 0; i < m_pixels.size(); ++i)
    {
        m_traced.mappedData()[i] = tracedPixel(m_pixels[i].y, window.height, buffers.height) * buffers.width +
                                   tracedPixel(m_pixels[i].x, window.width, buffers.width);
    }
    inspectPixels(graph, tree, camera, options, buffers, m_traced, m_reports);
}

std::span<const gpu::PixelReport> PixelProbe::reports() const
{
    return {m_reports.mappedData(), m_pixels.size()};
}

} // namespace zvo::demo
