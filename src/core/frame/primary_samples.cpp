// SPDX-License-Identifier: MIT
#include "core/frame/primary_samples.h"

#include <glm/gtc/constants.hpp>

#include <utility>

namespace zvo
{

namespace
{

// Radians by which a sample turns its occlusion rays: turns of any number of samples are spread evenly.
float turnOf(std::uint32_t sample)
{
    constexpr double kStep = 0.6180339887498949; // the golden section
    return static_cast<float>(glm::two_pi<double>() * glm::fract(kStep * sample));
}

} // namespace

PrimarySamples::PrimarySamples(vk::Device& device, std::uint32_t width, std::uint32_t height)
    : m_width(width), m_height(height),
      m_radiance(device, "trace/radiance", std::uint64_t{width} * height * texelWords(TexelFormat::Half)),
      m_sums(device, "trace/picture", std::uint64_t{width} * height)
{
}

void PrimarySamples::add(vk::FrameGraph& graph, TreeTracer& tracer, const DeviceTree& tree, const TraceCamera& camera,
                         const TraceOptions& options)
{
    const std::uint32_t sample = std::exchange(m_sample_count, 0); // should anything below throw
    TraceOptions of_sample = options;
    of_sample.exposure = 1.0F;
    of_sample.occlusion_turn = turnOf(sample);
    tracer.traceTo(graph, tree, shifted(camera, pointOfPixel(sample)), of_sample, {m_radiance, TexelFormat::Half});
    vk::Pass pass = graph.addPass(gpu::path::AddPicture{.adds = sample != 0});
    pass.dispatch(m_sums.count(), {pass.read(m_radiance), pass.readWrite(m_sums), m_width, m_height});
    m_sample_count = sample + 1;
}

} // namespace zvo
