// SPDX-License-Identifier: MIT
#include "demo/world/renderer.h"

#include "core/scene/camera.h"

#include <utility>

namespace zvo::demo
{

namespace
{

// Samples of earlier frames that count at most, where pictures are denoised.
constexpr std::uint32_t kHistoryMax = 16;

PathOptions pathOptionsOf(const ViewState& view)
{
    return {.reseeds = view.denoise, .features = view.denoise};
}

} // namespace

void Renderer::begin(std::uint64_t frame, const DeviceTree& tree, const Picture& picture, bool encodes_srgb)
{
    m_deletion_queue.beginFrame(frame);
    m_tracer.resize(picture.internal.width, picture.internal.height);
    m_tracer.reserve(tree);
    prepareLight(tree, picture);
    if (m_compose == nullptr || m_compose->size() != picture.window || m_compose->encodesSrgb() != encodes_srgb)
    {
        auto compose = std::make_unique<ComposeImage>(m_device.device(), m_pass, picture.window, encodes_srgb);
        m_deletion_queue.keep(std::exchange(m_compose, std::move(compose)));
    }
}

std::uint64_t Renderer::pictureBytes() const
{
    if (m_compose == nullptr)
    {
        return 0;
    }
    std::uint64_t light_bytes = 0;
    if (m_light != nullptr)
    {
        light_bytes = m_light->developer.bytes() + m_light->image.bytes() +
                      (keepsLight(m_light->integrator) ? m_light->kept.bytes()
                                                       : m_light->tracer.bytes() + m_light->denoiser.bytes());
    }
    return m_tracer.buffers().bytes() + m_compose->bytes() + light_bytes;
}

// Makes or drops what an integrator needs.
void Renderer::prepareLight(const DeviceTree& tree, const Picture& picture)
{
    const Integrator integrator = picture.view.shownIntegrator();
    if (m_light != nullptr && m_light->integrator != integrator)
    {
        m_deletion_queue.keep(std::exchange(m_light, nullptr));
    }
    if (integrator == Integrator::Primary)
    {
        return;
    }
    if (m_light == nullptr)
    {
        m_light = std::make_unique<Light>(m_device, &m_deletion_queue, integrator);
    }
    const std::uint64_t pixel_count = m_tracer.buffers().image.count();
    if (m_light->image.count() != pixel_count)
    {
        vk::BufferOf<gpu::uint> image(m_device.device(), "path picture", pixel_count);
        m_deletion_queue.keep(std::exchange(m_light->image, std::move(image)));
    }
    if (keepsLight(integrator))
    {
        m_light->kept.resize(picture.internal.width, picture.internal.height);
        m_light->kept.reserve(tree, {});
        return;
    }
    m_light->tracer.resize(picture.internal.width, picture.internal.height);
    if (picture.view.denoise)
    {
        m_light->denoiser.resize(picture.internal.width, picture.internal.height);
    }
}

void Renderer::traceLight(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                          const Picture& picture)
{
    const ViewState& view = picture.view;
    const double strength = view.shadows ? TraceOptions().sun : 0.0;
    m_light->sky.setSun({.direction = view.to_sun, .irradiance = strength * kSunColor});
    if (keepsLight(m_light->integrator))
    {
        if (picture.edited)
        {
            m_light->kept.cache().noteChange();
        }
        m_light->kept.beginPicture();
        m_light->kept.addFrame(graph, tree, m_light->sky, camera, {},
                               m_light->integrator == Integrator::Cones ? KeptView::Cones : KeptView::Faces);
        m_light->developer.develop(graph, m_light->kept.picture(), TexelFormat::Rgba8, {.factor = view.exposure},
                                   m_light->image);
        return;
    }
    m_light->tracer.addSample(graph, tree, m_light->sky, camera, pathOptionsOf(view), picture.ray_lists);
    if (view.denoise)
    {
        m_light->denoiser.denoise(graph, m_light->tracer.guided(), kHistoryMax);
    }
    const SampledPicture shown = view.denoise ? m_light->denoiser.picture() : m_light->tracer.picture();
    m_light->developer.develop(graph, shown, TexelFormat::Rgba8, {.factor = view.exposure}, m_light->image);
}

void Renderer::forget()
{
    m_tracer.forget();
    if (m_light != nullptr)
    {
        m_deletion_queue.keep(std::exchange(m_light, nullptr)); // begin() makes new ones
    }
}

std::optional<std::uint32_t> Renderer::sampleCount() const
{
    return integrator() == Integrator::Path ? std::optional(m_light->tracer.sampleCount()) : std::nullopt;
}

std::optional<std::uint32_t> Renderer::keptFrames() const
{
    return keepsLight(integrator()) ? std::optional(m_light->kept.cache().frameCount()) : std::nullopt;
}

std::uint64_t Renderer::rayListElements(const ViewState& view) const
{
    return integrator() == Integrator::Path ? m_light->tracer.listElements(pathOptionsOf(view)) : 0;
}

void Renderer::record(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture)
{
    const TraceBuffers& buffers = m_tracer.buffers();
    const TraceCamera camera = traceCamera(picture.camera, tree.grid, buffers.height);
    const TraceOptions options = picture.view.traceOptions();
    if (m_light == nullptr)
    {
        m_tracer.trace(graph, tree, camera, options);
    }
    else
    {
        traceLight(graph, tree, camera, picture);
    }
    if (picture.inspected && m_light != nullptr)
    {
        m_tracer.tracePrimary(graph, tree, camera, options); // for its hits
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
    m_compose->fill(graph, m_light == nullptr ? buffers.image : m_light->image, {buffers.width, buffers.height});
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
    if (picture.screenshot != nullptr || picture.inspected || picture.ray_lists != nullptr)
    {
        graph.releaseToHost();
    }
}

} // namespace zvo::demo
