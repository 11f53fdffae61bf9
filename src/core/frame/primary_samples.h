// SPDX-License-Identifier: MIT
#pragma once

#include "core/path/develop.h"
#include "core/trace/tree_tracer.h"

#include <cstdint>

namespace zvo
{

/// A lit picture by primary rays that is the mean of samples: they smooth its edges, and its occlusion rays go in more
/// directions. Owns its buffers.
class PrimarySamples
{
public:
    /// Throws Error{Memory}.
    PrimarySamples(vk::Device& device, std::uint32_t width, std::uint32_t height);

    /// Begins a new picture with the next sample.
    void begin() { m_sample_count = 0; }

    /// Records the passes that add a sample to each pixel. tracer: with buffers of the picture's size. Cost: as
    /// TreeTracer::trace().
    void add(vk::FrameGraph& graph, TreeTracer& tracer, const DeviceTree& tree, const TraceCamera& camera,
             const TraceOptions& options);

    /// The samples so far.
    [[nodiscard]] SampledPicture picture() const { return {m_sums, m_width, m_height, m_sample_count}; }

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const { return m_radiance.bytes() + m_sums.bytes(); }

private:
    std::uint32_t m_width;
    std::uint32_t m_height;
    vk::BufferOf<gpu::uint> m_radiance; // [pixels * 2] of the last sample, in half floats
    vk::BufferOf<gpu::PixelSum> m_sums; // [pixels] in the order of shaders/path/path.h
    std::uint32_t m_sample_count = 0;
};

} // namespace zvo
