// SPDX-License-Identifier: MIT
#include "core/denoise/denoiser.h"

#include "core/base/divide_up.h"
#include "vk/device.h"

#include <array>

namespace zvo
{

Denoiser::Pixels::Pixels(vk::Device& device, std::uint32_t picture_width, std::uint32_t picture_height)
    : width(picture_width), height(picture_height), cameras(device, "denoise/cameras", 2)
{
    const std::uint64_t pixel_count = std::uint64_t{width} * height;
    device.memory().require(pixel_count * (2 * (sizeof(gpu::vec4) + sizeof(gpu::DenoiseGuide) + sizeof(float)) +
                                           2 * sizeof(gpu::vec4) + sizeof(gpu::PixelSum)),
                            "denoising");
    for (Moment& moment : moments)
    {
        moment.light = {device, "denoise/light", pixel_count};
        moment.guides = {device, "denoise/guides", pixel_count};
        moment.samples = {device, "denoise/samples", pixel_count};
    }
    for (vk::BufferOf<gpu::vec4>& light : filtered)
    {
        light = {device, "denoise/filtered", pixel_count};
    }
    sums = {device, "denoise/sums", pixel_count};
}

void Denoiser::resize(std::uint32_t width, std::uint32_t height)
{
    if (m_pixels == nullptr || m_pixels->width != width || m_pixels->height != height)
    {
        vk::replace(m_deletion_queue, m_pixels, std::make_unique<Pixels>(m_device, width, height));
    }
}

void Denoiser::forget()
{
    if (m_pixels != nullptr)
    {
        now().subject = 0;
        before().subject = 0;
    }
}

std::uint64_t Denoiser::bytes() const
{
    if (m_pixels == nullptr)
    {
        return 0;
    }
    std::uint64_t sum = m_pixels->sums.bytes() + m_pixels->cameras.bytes();
    for (std::size_t i = 0; i < 2; ++i)
    {
        const Moment& moment = m_pixels->moments.at(i);
        sum += moment.light.bytes() + moment.guides.bytes() + moment.samples.bytes() + m_pixels->filtered.at(i).bytes();
    }
    return sum;
}

void Denoiser::denoise(vk::FrameGraph& graph, const GuidedPicture& guided, std::uint32_t history_max)
{
    if (now().subject != guided.subject)
    {
        m_now = 1 - m_now;
    }
    now().subject = 0; // should anything below throw
    demodulate(graph, guided);
    if (before().subject != 0 && before().lighting == guided.lighting)
    {
        reproject(graph, guided, history_max);
    }
    filter(graph, guided);
    modulate(graph, guided);
    now().camera = guided.camera;
    now().subject = guided.subject;
    now().lighting = guided.lighting;
}

void Denoiser::demodulate(vk::FrameGraph& graph, const GuidedPicture& guided)
{
    vk::Pass pass = graph.addPass(gpu::denoise::Demodulate{});
    pass.dispatch(m_pixels->sums.count(), {.sums = pass.read(guided.picture.sums),
                                           .features = pass.read(guided.features),
                                           .light = pass.write(now().light),
                                           .guides = pass.write(now().guides),
                                           .samples = pass.write(now().samples),
                                           .width = m_pixels->width,
                                           .height = m_pixels->height,
                                           .sample_count = static_cast<float>(guided.picture.sample_count)});
}

void Denoiser::reproject(vk::FrameGraph& graph, const GuidedPicture& guided, std::uint32_t history_max)
{
    const TraceCamera& old_camera = before().camera;
    graph.update(m_pixels->cameras, 0, std::array{guided.camera.inPicture(), old_camera.inPicture()});
    vk::Pass pass = graph.addPass(gpu::denoise::Reproject{.orthographic = guided.camera.orthographic,
                                                          .old_orthographic = old_camera.orthographic});
    pass.dispatch(m_pixels->sums.count(), {.light = pass.readWrite(now().light),
                                           .samples = pass.readWrite(now().samples),
                                           .guides = pass.read(now().guides),
                                           .old_light = pass.read(before().light),
                                           .old_samples = pass.read(before().samples),
                                           .old_guides = pass.read(before().guides),
                                           .cameras = pass.read(m_pixels->cameras),
                                           .width = m_pixels->width,
                                           .height = m_pixels->height,
                                           .history_max = static_cast<float>(history_max),
                                           .edge = guided.voxel_edge});
}

// Ends with the light in filtered[kDenoiseLevels % 2].
void Denoiser::filter(vk::FrameGraph& graph, const GuidedPicture& guided)
{
    const std::uint64_t tile_count =
        std::uint64_t{divideUp(m_pixels->width, gpu::kDenoiseTile)} * divideUp(m_pixels->height, gpu::kDenoiseTile);
    const auto addLevel =
        [&](auto&& pass, const vk::BufferOf<gpu::vec4>& light, vk::BufferOf<gpu::vec4>& filtered, std::uint32_t step)
    {
        pass.dispatch(tile_count * gpu::kDenoiseTile * gpu::kDenoiseTile,
                      {.light = pass.read(light),
                       .guides = pass.read(now().guides),
                       .samples = pass.read(now().samples),
                       .filtered = pass.write(filtered),
                       .forward = guided.camera.rays.forward,
                       .half_pixel_x = guided.camera.rays.half_pixel_x,
                       .half_pixel_y = guided.camera.rays.half_pixel_y,
                       .width = m_pixels->width,
                       .height = m_pixels->height,
                       .step = step,
                       .edge = guided.voxel_edge});
    };
    const bool orthographic = guided.camera.orthographic;
    std::array<vk::BufferOf<gpu::vec4>, 2>& filtered = m_pixels->filtered;
    addLevel(graph.addPass(gpu::denoise::Estimate{.orthographic = orthographic}), now().light, filtered[0], 1);
    for (std::uint32_t level = 0; level < gpu::kDenoiseLevels; ++level)
    {
        addLevel(graph.addPass(gpu::denoise::Filter{.orthographic = orthographic}), filtered.at(level % 2),
                 filtered.at((level + 1) % 2), 1U << level);
    }
}

void Denoiser::modulate(vk::FrameGraph& graph, const GuidedPicture& guided)
{
    vk::Pass pass = graph.addPass(gpu::denoise::Modulate{});
    pass.dispatch(m_pixels->sums.count(), {.light = pass.read(m_pixels->filtered.at(gpu::kDenoiseLevels % 2)),
                                           .features = pass.read(guided.features),
                                           .sums = pass.write(m_pixels->sums),
                                           .width = m_pixels->width,
                                           .height = m_pixels->height,
                                           .sample_part = 1.0F / static_cast<float>(guided.picture.sample_count)});
}

} // namespace zvo
