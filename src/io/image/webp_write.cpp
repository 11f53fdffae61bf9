// SPDX-License-Identifier: MIT
#include "io/image/webp_write.h"

#include "zvo/error.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

namespace zvo
{

namespace
{

constexpr int kWebpChannels = 4;

[[noreturn]] void fail(std::uint32_t width, std::uint32_t height)
{
    throw Error(ErrorCode::Memory, fmt::format("cannot encode a picture of {} x {} pixels as WebP: not enough memory; "
                                               "make it smaller",
                                               width, height));
}

WebPConfig configOf(std::uint32_t quality)
{
    assert(quality > 0 && quality <= kWebpLossless);
    WebPConfig config;
    WebPConfigInit(&config); // fails only where the library is another one than its header
    config.quality = static_cast<float>(quality);
    config.lossless = quality == kWebpLossless ? 1 : 0;
    return config;
}

// A picture in the form that libwebp takes.
struct Source : WebPPicture
{
    Source(std::uint32_t picture_width, std::uint32_t picture_height, std::span<const std::uint8_t> rgba)
    {
        assert(picture_width > 0 && picture_height > 0 && std::max(picture_width, picture_height) <= kWebpEdgeMax);
        assert(rgba.size() == std::size_t{picture_width} * picture_height * kWebpChannels);
        WebPPictureInit(this);
        use_argb = 1;
        width = static_cast<int>(picture_width);
        height = static_cast<int>(picture_height);
        if (WebPPictureImportRGBX(this, rgba.data(), width * kWebpChannels) == 0)
        {
            fail(picture_width, picture_height);
        }
    }
    ~Source() { WebPPictureFree(this); }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
};

} // namespace

std::vector<std::uint8_t> encodeWebp(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                     std::uint32_t quality)
{
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> owner(&writer, WebPMemoryWriterClear);
    Source source(width, height, rgba);
    source.writer = WebPMemoryWrite;
    source.custom_ptr = &writer;
    const WebPConfig config = configOf(quality);
    if (WebPEncode(&config, &source) == 0)
    {
        fail(width, height);
    }
    return {writer.mem, writer.mem + writer.size};
}

struct WebpAnimation::Encoder
{
    std::uint32_t width;
    std::uint32_t height;
    WebPConfig config;
    std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> made{nullptr, WebPAnimEncoderDelete};
};

WebpAnimation::WebpAnimation(std::uint32_t width, std::uint32_t height, std::uint32_t quality)
    : m_encoder(new Encoder{width, height, configOf(quality)})
{
    WebPAnimEncoderOptions options;
    WebPAnimEncoderOptionsInit(&options); // plays for ever
    m_encoder->made.reset(WebPAnimEncoderNew(static_cast<int>(width), static_cast<int>(height), &options));
    if (!m_encoder->made)
    {
        fail(width, height);
    }
}

WebpAnimation::~WebpAnimation() = default;
WebpAnimation::WebpAnimation(WebpAnimation&&) noexcept = default;
WebpAnimation& WebpAnimation::operator=(WebpAnimation&&) noexcept = default;

void WebpAnimation::add(std::span<const std::uint8_t> rgba, std::uint32_t begin_ms)
{
    Source source(m_encoder->width, m_encoder->height, rgba);
    if (WebPAnimEncoderAdd(m_encoder->made.get(), &source, static_cast<int>(begin_ms), &m_encoder->config) == 0)
    {
        fail(m_encoder->width, m_encoder->height);
    }
}

std::vector<std::uint8_t> WebpAnimation::finish(std::uint32_t end_ms)
{
    WebPData data;
    WebPDataInit(&data);
    const bool made = WebPAnimEncoderAdd(m_encoder->made.get(), nullptr, static_cast<int>(end_ms), nullptr) != 0 &&
                      WebPAnimEncoderAssemble(m_encoder->made.get(), &data) != 0;
    const std::unique_ptr<WebPData, decltype(&WebPDataClear)> owner(&data, WebPDataClear);
    if (!made)
    {
        fail(m_encoder->width, m_encoder->height);
    }
    return {data.bytes, data.bytes + data.size};
}

} // namespace zvo
