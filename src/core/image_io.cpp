// SPDX-License-Identifier: MIT
#include "core/image_io.h"

#include "zvo/error.h"

#include <algorithm>
#include <cassert>
#include <climits>
#include <fmt/format.h>
#include <memory>

// stb as static functions: a program that links zvo may bring its own.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
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

struct FreePixels
{
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

} // namespace

Image decodeImage(std::span<const std::uint8_t> encoded, const std::string& name, const std::string& where)
{
    const auto fail = [&](const std::string& what) -> Error {
        return {ErrorCode::Input, fmt::format("{}: {}", where, what)};
    };
    if (encoded.size() > INT_MAX)
    {
        throw fail("the image file is larger than 2 GiB; make it smaller");
    }
    const auto encoded_bytes = static_cast<int>(encoded.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(encoded.data(), encoded_bytes, &width, &height, &channels) == 0)
    {
        throw fail(fmt::format("not a PNG or JPEG image ({}); save it as one", stbi_failure_reason()));
    }
    if (std::max(width, height) > static_cast<int>(kImageEdgeMax))
    {
        throw fail(fmt::format("the image has {} x {} pixels, more than {} on an edge; scale it down", width, height,
                               kImageEdgeMax));
    }
    const std::unique_ptr<stbi_uc, FreePixels> pixels(
        stbi_load_from_memory(encoded.data(), encoded_bytes, &width, &height, &channels, kChannels));
    if (!pixels)
    {
        throw fail(fmt::format("the image does not decode ({}); save it again", stbi_failure_reason()));
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
