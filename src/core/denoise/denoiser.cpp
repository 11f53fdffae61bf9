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
    gpu::DenoiseDemodulateParams params{};
    params.sums = pass.read(guided.picture.sums);
    params.features = pass.read(guided.features);
    params.light = pass.write(now().light);
    params.guides = pass.write(now().guides);
    params.samples = pass.write(now().samples);
    params.width = m_pixels->width;
    params.height = m_pixels->height;
    params.sample_count = static_cast<float>(guided.picture.sample_count);
    pass.dispatch(m_pixels->sums.count(), params);
}

void Denoiser::reproject(vk::FrameGraph& graph, const GuidedPicture& guided, std::uint32_t history_max)
{
    const TraceCamera& old_camera = before().camera;
    graph.update(m_pixels->cameras, 0, std::array{guided.camera.rays, old_camera.rays});
    vk::Pass pass = graph.addPass(gpu::denoise::Reproject{.orthographic = guided.camera.orthographic,
                                                          .old_orthographic = old_camera.orthographic});
    gpu::DenoiseReprojectParams params{};
    params.light = pass.readWrite(now().light);
    params.samples = pass.readWrite(now().samples);
    params.guides = pass.read(now().guides);
    params.old_light = pass.read(before().light);
    params.old_samples = pass.read(before().samples);
    params.old_guides = pass.read(before().guides);
    params.cameras = pass.read(m_pixels->cameras);
    params.width = m_pixels->width;
    params.height = m_pixels->height;
    params.history_max = static_cast<float>(history_max);
    params.edge = guided.voxel_edge;
    pass.dispatch(m_pixels->sums.count(), params);
}

// Ends with the light in filtered[kDenoiseLevels % 2].
void Denoiser::filter(vk::FrameGraph& graph, const GuidedPicture& guided)
{
    const std::uint64_t tile_count =
        std::uint64_t{divideUp(m_pixels->width, gpu::kDenoiseTile)} * divideUp(m_pixels->height, gpu::kDenoiseTile);
    const auto addLevel =
        [&](auto&& pass, const vk::BufferOf<gpu::vec4>& light, vk::BufferOf<gpu::vec4>& filtered, std::uint32_t step)
    {
        gpu::DenoiseFilterParams params{};
        params.light = pass.read(light);
        params.guides = pass.read(now().guides);
        params.samples = pass.read(now().samples);
        params.filtered = pass.write(filtered);
        params.forward = guided.camera.rays.forward;
        params.half_pixel_x = guided.camera.rays.half_pixel_x;
        params.half_pixel_y = guided.camera.rays.half_pixel_y;
        params.width = m_pixels->width;
        params.height = m_pixels->height;
        params.step = step;
        params.edge = guided.voxel_edge;
        pass.dispatch(tile_count * gpu::kDenoiseTile * gpu::kDenoiseTile, params);
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
    gpu::DenoiseModulateParams params{};
    params.light = pass.read(m_pixels->filtered.at(gpu::kDenoiseLevels % 2));
    params.features = pass.read(guided.features);
    params.sums = pass.write(m_pixels->sums);
    params.width = m_pixels->width;
    params.height = m_pixels->height;
    params.sample_part = 1.0F / static_cast<float>(guided.picture.sample_count);
    pass.dispatch(m_pixels->sums.count(), params);
}

} // namespace zvo
