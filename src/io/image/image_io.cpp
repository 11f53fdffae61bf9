// SPDX-License-Identifier: MIT
#include "io/image/image_io.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "io/image/image_check.h"
#include "zvo/error.h"

#include <algorithm>
#include <cassert>
#include <climits>
#include <cstdlib>
#include <fmt/format.h>
#include <new>
#include <string_view>
#include <utility>
#include <webp/decode.h>

namespace
{

/// The most bytes of one allocation of the decoder. It stops small files that unpack without end.
thread_local std::size_t t_decoder_bytes_max = 0;
thread_local bool t_decoder_lacks_memory = false; // that it was allowed to have

/// The memory is zero, so that pixels missing in a file are the same on every run.
void* decoderAllocate(std::size_t bytes)
{
    void* const made = bytes <= t_decoder_bytes_max ? std::calloc(bytes, 1) : nullptr;
    t_decoder_lacks_memory = t_decoder_lacks_memory || (made == nullptr && bytes <= t_decoder_bytes_max);
    return made;
}

void* decoderReallocate(void* old, std::size_t bytes)
{
    void* const made = bytes <= t_decoder_bytes_max ? std::realloc(old, bytes) : nullptr;
    t_decoder_lacks_memory = t_decoder_lacks_memory || (made == nullptr && bytes <= t_decoder_bytes_max);
    return made;
}

} // namespace

// stb's functions are static, because a program that links zvo may have its own.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#define STBI_MALLOC(bytes) decoderAllocate(bytes)
#define STBI_REALLOC(old, bytes) decoderReallocate(old, bytes)
#define STBI_FREE(old) std::free(old)
#include <stb/stb_image.h>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace zvo
{

namespace
{

constexpr int kChannels = 4;
constexpr std::size_t kDecoderBytesMin = std::size_t{1} << 16U; // for its tables

// Appends to the vector of bytes that is the context, as stb's writers want it.
void appendBytes(void* context, void* data, int count)
{
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + count);
}

/// What a writer of stb makes of a picture.
template <typename Write, typename... Rest>
std::vector<std::uint8_t> encoded(const char* kind, std::uint32_t width, std::uint32_t height, Write* write,
                                  Rest... rest)
{
    std::vector<std::uint8_t> bytes;
    if (write(appendBytes, &bytes, static_cast<int>(width), static_cast<int>(height), rest...) == 0)
    {
        throw Error(ErrorCode::Memory, fmt::format("cannot encode a picture of {} x {} pixels as {}: not enough "
                                                   "memory; make it smaller",
                                                   width, height, kind));
    }
    return bytes;
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
    const std::string_view text = asText(encoded);
    return text.starts_with("RIFF") && text.substr(std::min<std::size_t>(text.size(), 8)).starts_with("WEBP");
}

/// What an encoded image announces.
struct ImageHeader
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t decoder_bytes_max = 0; // of one allocation of the decoder

    [[nodiscard]] std::size_t rgbaBytes() const { return std::size_t{width} * height * kChannels; }
    bool operator==(const ImageHeader&) const = default;
};

ImageHeader readWebpHeader(std::span<const std::uint8_t> encoded, const std::string& where, std::uint64_t bytes_max)
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
    return {static_cast<std::uint32_t>(features.width), static_cast<std::uint32_t>(features.height)};
}

/// Finds all that is wrong with an image before it is decoded.
ImageHeader readHeader(std::span<const std::uint8_t> encoded, const std::string& where, std::uint64_t bytes_max)
{
    const auto fail = [&](const std::string& what) { return imageError(where, what); };
    if (encoded.empty())
    {
        throw fail("not a PNG, JPEG, WebP, BMP or TGA image (it is empty); save it as one");
    }
    if (encoded.size() > INT_MAX)
    {
        throw fail("the image file is larger than 2 GiB; make it smaller");
    }
    if (isWebp(encoded))
    {
        return readWebpHeader(encoded, where, bytes_max);
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    t_decoder_bytes_max = kDecoderBytesMin;
    if (const std::string fault = findImageFault(encoded); !fault.empty())
    {
        throw fail(fmt::format("the image does not decode ({}); save it again", fault));
    }
    if (stbi_info_from_memory(encoded.data(), static_cast<int>(encoded.size()), &width, &height, &channels) == 0)
    {
        throw fail("not a PNG, JPEG, WebP, BMP or TGA image, or its header is broken; save it as one of them");
    }
    checkSize(width, height, bytes_max, where);
    ImageHeader header{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    const ImageCost cost = estimateImageCost(encoded, header.width, header.height);
    if (!cost.plausible)
    {
        throw fail(fmt::format("the image announces {} x {} pixels, more than its {} bytes can hold; save it again",
                               width, height, encoded.size()));
    }
    // The factor 2 allows the decoder to double a buffer that is too small.
    header.decoder_bytes_max =
        kDecoderBytesMin + 2 * (encoded.size() + std::max<std::size_t>(cost.raw_bytes, header.rgbaBytes()));
    return header;
}

Pixels decodePixels(std::span<const std::uint8_t> encoded, const ImageHeader& header, const std::string& where)
{
    if (isWebp(encoded))
    {
        Pixels pixels(static_cast<std::uint8_t*>(std::malloc(header.rgbaBytes())));
        if (!pixels)
        {
            throw std::bad_alloc();
        }
        if (WebPDecodeRGBAInto(encoded.data(), encoded.size(), pixels.get(), header.rgbaBytes(),
                               static_cast<int>(header.width) * kChannels) == nullptr)
        {
            throw imageError(where, "the WebP image does not decode; save it again");
        }
        return pixels;
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    t_decoder_bytes_max = header.decoder_bytes_max;
    t_decoder_lacks_memory = false;
    Pixels pixels(stbi_load_from_memory(encoded.data(), static_cast<int>(encoded.size()), &width, &height, &channels,
                                        kChannels)); // from decoderAllocate()
    if (t_decoder_lacks_memory)
    {
        throw std::bad_alloc();
    }
    if (!pixels)
    {
        throw imageError(where, "the image does not decode; save it again");
    }
    return pixels;
}

} // namespace

Image decodeImage(std::span<const std::uint8_t> encoded, const std::string& name, const std::string& where,
                  std::uint64_t bytes_max)
{
    const ImageHeader header = readHeader(encoded, where, bytes_max);
    const Pixels pixels = decodePixels(encoded, header, where);
    return {name, header.width, header.height, {pixels.get(), pixels.get() + header.rgbaBytes()}};
}

Image deferImage(std::span<const std::uint8_t> encoded, EncodedImage source, const std::string& name,
                 const std::string& where, const std::filesystem::path& path, std::uint64_t bytes_max)
{
    const ImageHeader header = readHeader(encoded, where, bytes_max);
    Image image;
    image.name = name;
    image.width = header.width;
    image.height = header.height;
    image.decode = [source = std::move(source), header, where, path, bytes_max]
    {
        try
        {
            const std::vector<std::uint8_t> read = source.bytes
                                                       ? std::vector<std::uint8_t>()
                                                       : readFile(source.file, source.first_byte, source.byte_count);
            const std::span<const std::uint8_t> bytes = source.bytes ? *source.bytes : read;
            if (readHeader(bytes, where, bytes_max) != header)
            {
                throw imageError(where, "the image has changed since its size was read; load it again");
            }
            return decodePixels(bytes, header, where);
        }
        catch (const Error& failure)
        {
            throw inputError(path, failure.what());
        }
    };
    return image;
}

std::vector<std::uint8_t> encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba)
{
    assert(width > 0 && height > 0 && std::max(width, height) <= kImageEdgeMax);
    assert(rgba.size() == std::size_t{width} * height * kChannels);
    const auto row_bytes = static_cast<int>(width) * kChannels;
    return encoded("PNG", width, height, stbi_write_png_to_func, kChannels, rgba.data(), row_bytes);
}

std::vector<std::uint8_t> encodeJpeg(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                     std::uint32_t quality)
{
    assert(width > 0 && height > 0 && std::max(width, height) <= kImageEdgeMax && quality > 0 && quality <= 100);
    assert(rgba.size() == std::size_t{width} * height * kChannels);
    return encoded("JPEG", width, height, stbi_write_jpg_to_func, kChannels, rgba.data(), static_cast<int>(quality));
}

std::vector<std::uint8_t> encodeHdr(const HdrImage& image)
{
    return encoded("Radiance", image.width, image.height, stbi_write_hdr_to_func, 3, &image.texels.front().x);
}

Error imageError(const std::string& where, const std::string& what)
{
    return {ErrorCode::Input, fmt::format("{}: {}", where, what)};
}

} // namespace zvo
