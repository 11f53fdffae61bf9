// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/hdr_image.h"
#include "core/trace/trace.h"
#include "path/path.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <span>

namespace zvo
{

/// The samples of a picture on the device.
struct SampledPicture
{
    const vk::BufferOf<gpu::PixelSum>& sums; // [width * height] in the order of shaders/path/path.h
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t sample_count; // of each pixel
};

/// How bright a picture is.
struct Exposure
{
    /// By the pixels' brightness (shaders/path/expose.comp), before the factor is applied.
    bool automatic = true;
    float factor = 1.0F;

    bool operator==(const Exposure&) const = default;
};

/// Makes pictures that can be shown of sums of radiance.
class Developer
{
public:
    /// Throws Error{Memory}.
    explicit Developer(vk::Device& device)
        : m_brightness(device, "path/brightness", gpu::kMeterBins), m_exposure(device, "path/exposure", 1)
    {
    }

    /// Records the passes that make the picture of the mean of all samples: image, [width * height *
    /// texelWords(texels)]. Without samples it is black. Cost: pixels.
    void develop(vk::FrameGraph& graph, const SampledPicture& picture, TexelFormat texels, const Exposure& exposure,
                 vk::BufferOf<gpu::uint>& image);

    /// [1] the factor of the radiance in the last picture.
    [[nodiscard]] const vk::BufferOf<float>& exposure() const { return m_exposure; }

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const { return m_brightness.bytes() + m_exposure.bytes(); }

private:
    void expose(vk::FrameGraph& graph, const SampledPicture& picture, float factor);

    vk::BufferOf<gpu::uint> m_brightness; // [kMeterBins] numbers of pixels
    vk::BufferOf<float> m_exposure;       // [1]
};

/// The mean radiance of each pixel, from SampledPicture::sums.
HdrImage pictureOf(std::span<const gpu::PixelSum> sums, std::uint32_t width, std::uint32_t height,
                   std::uint32_t sample_count);

} // namespace zvo
