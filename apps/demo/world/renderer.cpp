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
    preparePaths(picture);
    if (m_compose == nullptr || m_compose->size() != picture.window || m_compose->encodesSrgb() != encodes_srgb)
    {
        auto compose = std::make_unique<ComposeImage>(m_device.device(), m_pass, picture.window, encodes_srgb);
        m_deletion_queue.keep(std::exchange(m_compose, std::move(compose)));
    }
}

std::uint64_t Renderer::pictureBytes() const
{
    const std::uint64_t path_bytes = m_paths == nullptr ? 0
                                                        : m_paths->tracer.bytes() + m_paths->denoiser.bytes() +
                                                              m_paths->developer.bytes() + m_paths->image.bytes();
    return m_compose == nullptr ? 0 : m_tracer.buffers().bytes() + m_compose->bytes() + path_bytes;
}

// Makes or drops what path tracing needs.
void Renderer::preparePaths(const Picture& picture)
{
    if (!picture.view.showsPaths())
    {
        if (m_paths != nullptr)
        {
            m_deletion_queue.keep(std::exchange(m_paths, nullptr));
        }
        return;
    }
    if (m_paths == nullptr)
    {
        m_paths = std::make_unique<Paths>(m_device, &m_deletion_queue);
    }
    const std::uint64_t pixel_count = m_tracer.buffers().image.count();
    if (m_paths->image.count() != pixel_count)
    {
        vk::BufferOf<gpu::uint> image(m_device.device(), "path picture", pixel_count);
        m_deletion_queue.keep(std::exchange(m_paths->image, std::move(image)));
    }
    m_paths->tracer.resize(picture.internal.width, picture.internal.height);
    if (picture.view.denoise)
    {
        m_paths->denoiser.resize(picture.internal.width, picture.internal.height);
    }
}

void Renderer::tracePaths(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                          const Picture& picture)
{
    const ViewState& view = picture.view;
    const double strength = view.shadows ? TraceOptions().sun : 0.0;
    m_paths->sky.setSun({.direction = view.to_sun, .irradiance = strength * kSunColor});
    m_paths->tracer.addSample(graph, tree, m_paths->sky, camera, pathOptionsOf(view), picture.ray_lists);
    if (view.denoise)
    {
        m_paths->denoiser.denoise(graph, m_paths->tracer.guided(), kHistoryMax);
    }
    const SampledPicture shown = view.denoise ? m_paths->denoiser.picture() : m_paths->tracer.picture();
    m_paths->developer.develop(graph, shown, TexelFormat::Rgba8, {.factor = view.exposure}, m_paths->image);
}

void Renderer::forget()
{
    m_tracer.forget();
    if (m_paths != nullptr)
    {
        m_deletion_queue.keep(std::exchange(m_paths, nullptr)); // begin() makes new ones
    }
}

std::optional<std::uint32_t> Renderer::sampleCount() const
{
    return m_paths == nullptr ? std::nullopt : std::optional(m_paths->tracer.sampleCount());
}

std::uint64_t Renderer::rayListElements(const ViewState& view) const
{
    return m_paths == nullptr ? 0 : m_paths->tracer.listElements(pathOptionsOf(view));
}

void Renderer::record(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture)
{
    const TraceBuffers& buffers = m_tracer.buffers();
    const TraceCamera camera = traceCamera(picture.camera, tree.grid, buffers.height);
    const TraceOptions options = picture.view.traceOptions();
    if (m_paths == nullptr)
    {
        m_tracer.trace(graph, tree, camera, options);
    }
    else
    {
        tracePaths(graph, tree, camera, picture);
    }
    if (picture.inspected && m_paths != nullptr)
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
    m_compose->fill(graph, m_paths == nullptr ? buffers.image : m_paths->image, {buffers.width, buffers.height});
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
