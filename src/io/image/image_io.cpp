// SPDX-License-Identifier: MIT
#include "io/image/image_io.h"

#include "io/image/image_check.h"
#include "zvo/error.h"

#include <algorithm>
#include <cassert>
#include <climits>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <webp/decode.h>

namespace
{

/// The most bytes of one allocation of the decoder. It stops small files that unpack without end.
thread_local std::size_t t_decoder_bytes_max = 0;

/// The memory is zero, so that pixels missing in a file are the same on every run.
void* decoderAllocate(std::size_t bytes)
{
    return bytes <= t_decoder_bytes_max ? std::calloc(bytes, 1) : nullptr;
}

void* decoderReallocate(void* old, std::size_t bytes)
{
    return bytes <= t_decoder_bytes_max ? std::realloc(old, bytes) : nullptr;
}

} // namespace

// stb's functions are static, because a program that links zvo may have its own.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#define STBI_MALLOC(bytes) decoderAllocate(bytes)
#define STBI_REALLOC(old, bytes) decoderReallocate(old, bytes)
#define STBI_FREE(old) std::free(old)
#include <stb/stb_image.h>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace zvo
{

namespace
{

constexpr int kChannels = 4;
constexpr std::size_t kDecoderBytesMin = std::size_t{1} << 16U; // for its tables

struct FreePixels
{
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

Error imageError(const std::string& where, const std::string& what)
{
    return {ErrorCode::Input, fmt::format("{}: {}", where, what)};
}

// Throws if a picture is too large, or takes more than bytes_max bytes decoded.
void checkSize(int width, int height, std::uint64_t bytes_max, const std::string& where)
{
    if (std::max(width, height) > static_cast<int>(kImageEdgeMax))
    {
        throw imageError(where, fmt::format("the image has {} x {} pixels, more than {} on an edge; scale it down",
                                            width, height, kImageEdgeMax));
    }
    if (std::uint64_t{static_cast<std::uint32_t>(width)} * static_cast<std::uint32_t>(height) * kChannels > bytes_max)
    {
        throw imageError(where, fmt::format("with its {} x {} pixels, the scene's images take more than {} bytes; "
                                            "scale them down",
                                            width, height, bytes_max));
    }
}

bool isWebp(std::span<const std::uint8_t> encoded)
{
    const std::string_view text(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    return text.starts_with("RIFF") && text.substr(std::min<std::size_t>(text.size(), 8)).starts_with("WEBP");
}

Image decodeWebp(std::span<const std::uint8_t> encoded, const std::string& name, const std::string& where,
                 std::uint64_t bytes_max)
{
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(encoded.data(), encoded.size(), &features) != VP8_STATUS_OK)
    {
        throw imageError(where, "the WebP image does not decode (no valid header); save it again");
    }
    if (features.has_animation != 0)
    {
        throw imageError(where, "the WebP image is an animation; save one picture of it");
    }
    checkSize(features.width, features.height, bytes_max, where);
    Image image{.name = name,
                .width = static_cast<std::uint32_t>(features.width),
                .height = static_cast<std::uint32_t>(features.height),
                .rgba = {}};
    image.rgba.resize(std::size_t{image.width} * image.height * kChannels);
    if (WebPDecodeRGBAInto(encoded.data(), encoded.size(), image.rgba.data(), image.rgba.size(),
                           features.width * kChannels) == nullptr)
    {
        throw imageError(where, "the WebP image does not decode; save it again");
    }
    return image;
}

} // namespace

Image decodeImage(std::span<const std::uint8_t> encoded, const std::string& name, const std::string& where,
                  std::uint64_t bytes_max)
{
    const auto fail = [&](const std::string& what) { return imageError(where, what); };
    if (encoded.empty())
    {
        throw fail("not a PNG, JPEG or WebP image (it is empty); save it as one");
    }
    if (encoded.size() > INT_MAX)
    {
        throw fail("the image file is larger than 2 GiB; make it smaller");
    }
    if (isWebp(encoded))
    {
        return decodeWebp(encoded, name, where, bytes_max);
    }
    const auto encoded_bytes = static_cast<int>(encoded.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    t_decoder_bytes_max = kDecoderBytesMin;
    if (const std::string fault = findImageFault(encoded); !fault.empty())
    {
        throw fail(fmt::format("the image does not decode ({}); save it again", fault));
    }
    if (stbi_info_from_memory(encoded.data(), encoded_bytes, &width, &height, &channels) == 0)
    {
        throw fail("not a PNG, JPEG or WebP image, or its header is broken; save it as one of them");
    }
    checkSize(width, height, bytes_max, where);
    const ImageCost cost =
        estimateImageCost(encoded, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    if (!cost.plausible)
    {
        throw fail(fmt::format("the image announces {} x {} pixels, more than its {} bytes can hold; save it again",
                               width, height, encoded.size()));
    }
    const std::size_t rgba_bytes = std::size_t{static_cast<std::uint32_t>(width)} * height * kChannels;
    // The factor 2 allows the decoder to double a buffer that is too small.
    t_decoder_bytes_max = kDecoderBytesMin + 2 * (encoded.size() + std::max<std::size_t>(cost.raw_bytes, rgba_bytes));
    const std::unique_ptr<stbi_uc, FreePixels> pixels(
        stbi_load_from_memory(encoded.data(), encoded_bytes, &width, &height, &channels, kChannels));
    if (!pixels)
    {
        throw fail("the image does not decode; save it again");
    }
    Image image;
    image.name = name;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.rgba.assign(pixels.get(), pixels.get() + std::size_t{image.width} * image.height * kChannels);
    return image;
}

std::vector<std::uint8_t> encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba)
{
    assert(width > 0 && height > 0 && std::max(width, height) <= kImageEdgeMax);
    assert(rgba.size() == std::size_t{width} * height * kChannels);
    std::vector<std::uint8_t> png;
    const auto append = [](void* context, void* data, int bytes)
    {
        const auto* first = static_cast<const std::uint8_t*>(data);
        static_cast<std::vector<std::uint8_t>*>(context)->insert(
            static_cast<std::vector<std::uint8_t>*>(context)->end(), first, first + bytes);
    };
    const auto row_bytes = static_cast<int>(width) * kChannels;
    if (stbi_write_png_to_func(append, &png, static_cast<int>(width), static_cast<int>(height), kChannels, rgba.data(),
                               row_bytes) == 0)
    {
        throw Error(ErrorCode::Memory, fmt::format("cannot encode a picture of {} x {} pixels as PNG: not enough "
                                                   "memory; make it smaller",
                                                   width, height));
    }
    return png;
}

} // namespace zvo
