// SPDX-License-Identifier: MIT
#include "renderer.h"

#include "common/output.h"
#include "common/report.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>

namespace zvo::cli
{

namespace
{

// Time of the passes up to the last primary rays. Later passes compute light and colour.
double primaryMs(const std::vector<vk::PassTime>& passes)
{
    double ms = 0;
    double ms_until_primary = 0;
    for (const vk::PassTime& pass : passes)
    {
        ms += pass.ms;
        if (pass.name == "trace/primary" || pass.name == "trace/primary_ranks" || pass.name == "trace/ranks")
        {
            ms_until_primary = ms;
        }
    }
    return ms_until_primary;
}

void setSize(TreeTracer& tracer, const RenderOptions& options)
{
    try
    {
        tracer.resize(options.width, options.height);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        throw Error(ErrorCode::Memory, fmt::format("a picture of {} x {} pixels (--size) is too large: {}, or a "
                                                   "smaller picture",
                                                   options.width, options.height, error.what()));
    }
}

} // namespace

Renderer::Renderer(vk::HeadlessDevice& device, const RenderOptions& options)
    : m_device(device), m_options(options), m_tracer(device.device())
{
    m_trace.view = options.view;
    m_trace.detail_pixels = options.detail_pixels;
    m_trace.occlusion_rays = options.occlusion_rays;
    m_trace.exposure = options.exposure.value_or(m_trace.exposure);
    m_trace.to_sun = options.to_sun.value_or(m_trace.to_sun);
    if (options.hasSamples())
    {
        m_light.emplace(device, options);
    }
}

std::vector<vk::PassTime> Renderer::show(const DeviceTree& tree)
{
    m_tree = &tree;
    if (m_light)
    {
        return {};
    }
    setSize(m_tracer, m_options);
    return m_device.run([&](vk::FrameGraph& graph) { m_tracer.prepare(graph, tree); });
}

// The picture whose light is computed by samples; nothing, with a warning, if there is no room to keep light on voxels.
std::optional<std::vector<std::uint8_t>> Renderer::renderLight(const ViewCamera& view, Progress& progress,
                                                               PictureTimes& times)
{
    try
    {
        std::vector<std::uint8_t> picture = m_light->render(*m_tree, view, progress, times.passes);
        times.trace_ms = sumMs(times.passes);
        times.samples = m_light->sampleCount();
        times.exposure = m_light->exposure();
        m_capped_rays = (m_light->kept() == nullptr ? m_capped_rays : 0) + m_light->cappedRays();
        return picture;
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory || !keepsLight(m_options.integrator) ||
            extensionOf(m_options.output.path) != ".png")
        {
            throw;
        }
        talk(fmt::format("warning: no light is kept on voxels, and pictures are by --integrator primary: {}",
                         error.what()));
        return std::nullopt;
    }
}

std::vector<std::uint8_t> Renderer::render(const ViewCamera& view, Progress& progress, PictureTimes& times)
{
    if (m_light)
    {
        if (std::optional<std::vector<std::uint8_t>> picture = renderLight(view, progress, times))
        {
            return std::move(*picture);
        }
        m_light.reset();
        show(*m_tree);
    }
    const TraceBuffers& buffers = m_tracer.buffers();
    const TraceCamera camera = traceCamera(view, m_tree->grid, buffers.height);
    times.passes = m_device.run([&](vk::FrameGraph& graph) { m_tracer.trace(graph, *m_tree, camera, m_trace); });
    times.trace_ms = primaryMs(times.passes);
    times.shade_ms = sumMs(times.passes) - times.trace_ms;
    m_capped_rays += m_device.download(buffers.status).front().capped_rays;
    const std::vector<gpu::uint> image = m_device.download(buffers.image);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(image.data());
    return encodePng(buffers.width, buffers.height, {bytes, image.size() * sizeof(gpu::uint)});
}

} // namespace zvo::cli
