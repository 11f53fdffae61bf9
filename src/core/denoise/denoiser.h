// SPDX-License-Identifier: MIT
#pragma once

#include "core/path/path_tracer.h"
#include "denoise/denoise.h"
#include "vk/deletion_queue.h"
#include "vk/frame_graph.h"

#include <array>
#include <cstdint>
#include <memory>

namespace zvo
{

/// Makes smooth pictures of a few samples: a variance-guided filter that keeps edges (shaders/denoise/denoise.h). Where
/// an earlier picture shows the same place, its samples count, too.
class Denoiser
{
public:
    /// deletion_queue: as in TreeTracer.
    explicit Denoiser(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr)
        : m_device(device), m_deletion_queue(deletion_queue)
    {
    }

    /// Sets the size of the pictures, and forgets earlier ones if that is another one. Must be called before the first
    /// picture. Throws Error{Memory}; then the size stays as it was.
    void resize(std::uint32_t width, std::uint32_t height);

    /// Forgets earlier pictures: because the last frame was lost, or kernels may have changed.
    void forget();

    /// Records the passes that make the denoised picture of the samples so far. guided: a picture of this size with
    /// features (PathOptions::features) and at least one sample. The last picture of another subject
    /// (GuidedPicture::subject) becomes the earlier one, if it shows the same light. history_max: samples of the
    /// earlier picture that count at most, in a pixel; more smooth better and follow changes of light later. Cost:
    /// pixels.
    void denoise(vk::FrameGraph& graph, const GuidedPicture& guided, std::uint32_t history_max);

    /// The denoised picture, as one sample.
    [[nodiscard]] SampledPicture picture() const { return {m_pixels->sums, m_pixels->width, m_pixels->height, 1}; }

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    /// Light before the filter, with what tells whether another picture shows the same.
    struct Moment
    {
        vk::BufferOf<gpu::vec4> light;          // [width * height]
        vk::BufferOf<gpu::DenoiseGuide> guides; // [width * height]
        vk::BufferOf<float> samples;            // [width * height]
        TraceCamera camera;
        std::uint64_t subject = 0; // 0: nothing
        std::uint64_t lighting = 0;
    };
    struct Pixels
    {
        Pixels(vk::Device& device, std::uint32_t width, std::uint32_t height);

        std::uint32_t width;
        std::uint32_t height;
        std::array<Moment, 2> moments;
        std::array<vk::BufferOf<gpu::vec4>, 2> filtered; // [width * height]
        vk::BufferOf<gpu::PixelSum> sums;                // [width * height]
        vk::BufferOf<gpu::PictureCamera> cameras;        // [2]
    };

    void demodulate(vk::FrameGraph& graph, const GuidedPicture& guided);
    void reproject(vk::FrameGraph& graph, const GuidedPicture& guided, std::uint32_t history_max);
    void filter(vk::FrameGraph& graph, const GuidedPicture& guided);
    void modulate(vk::FrameGraph& graph, const GuidedPicture& guided);

    [[nodiscard]] Moment& now() const { return m_pixels->moments.at(m_now); }
    [[nodiscard]] Moment& before() const { return m_pixels->moments.at(1 - m_now); }

    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    std::unique_ptr<Pixels> m_pixels;
    std::size_t m_now = 0; // of moments, the other one is that of the earlier picture
};

} // namespace zvo
