// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "core/trace/trace.h"
#include "vk/buffer.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo::demo
{

/// Pixels of the window about which a frame reports what their rays meet.
class PixelProbe
{
public:
    /// pixels: at least one.
    PixelProbe(vk::Device& device, std::vector<glm::uvec2> pixels);

    /// Records the pass, after the picture's hits are there. window: the size in which the picture is shown.
    void record(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
                const TraceBuffers& buffers, PictureSize window);

    /// What was found, in the order of pixels, once the device is done with the frame.
    [[nodiscard]] std::span<const gpu::PixelReport> reports() const;

private:
    std::vector<glm::uvec2> m_pixels;
    vk::BufferOf<gpu::uint> m_traced; // the pixels of the traced picture
    vk::BufferOf<gpu::PixelReport> m_reports;
};

} // namespace zvo::demo
