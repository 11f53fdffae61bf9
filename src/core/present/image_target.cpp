// SPDX-License-Identifier: MIT
#include "core/present/image_target.h"

#include "vk/image_copy.h"
#include "zvo/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace zvo
{

namespace
{

struct ColorFormat
{
    VkFormat format;
    TexelFormat texels;
    const char* name;
};

constexpr ColorFormat kColorFormats[] = {
    {VK_FORMAT_R8G8B8A8_UNORM, TexelFormat::Rgba8, "R8G8B8A8_UNORM"},
    {VK_FORMAT_R8G8B8A8_SRGB, TexelFormat::Rgba8, "R8G8B8A8_SRGB"},
    {VK_FORMAT_B8G8R8A8_UNORM, TexelFormat::Bgra8, "B8G8R8A8_UNORM"},
    {VK_FORMAT_B8G8R8A8_SRGB, TexelFormat::Bgra8, "B8G8R8A8_SRGB"},
    {VK_FORMAT_A2B10G10R10_UNORM_PACK32, TexelFormat::Rgb10, "A2B10G10R10_UNORM_PACK32"},
    {VK_FORMAT_R16G16B16A16_SFLOAT, TexelFormat::Half, "R16G16B16A16_SFLOAT"},
};

struct DepthFormat
{
    VkFormat format;
    VkImageAspectFlags aspect;
    const char* name;
};

constexpr DepthFormat kDepthFormats[] = {
    {VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT, "D32_SFLOAT"},
    {VK_FORMAT_D32_SFLOAT_S8_UINT, VK_IMAGE_ASPECT_DEPTH_BIT, "D32_SFLOAT_S8_UINT"},
    {VK_FORMAT_R32_SFLOAT, VK_IMAGE_ASPECT_COLOR_BIT, "R32_SFLOAT"},
};

// The entry for a format. what: of which the image cannot take any.
template <typename Format, std::size_t Count>
const Format& entryFor(const Format (&formats)[Count], VkFormat format, const char* what)
{
    const Format* const found =
        std::ranges::find_if(formats, [&](const Format& known) { return known.format == format; });
    if (found != std::end(formats))
    {
        return *found;
    }
    std::string names;
    for (const Format& known : formats)
    {
        names += names.empty() ? "" : ", ";
        names += known.name;
    }
    throw Error(ErrorCode::Usage, fmt::format("zvo cannot copy {} into an image of VkFormat {}: use one of {}", what,
                                              static_cast<int>(format), names));
}

const char* wordsFor(TexelFormat texels)
{
    switch (texels)
    {
    case TexelFormat::Rgba8:
        return "RGBA with 8 bits";
    case TexelFormat::Bgra8:
        return "BGRA with 8 bits";
    case TexelFormat::Rgb10:
        return "RGBA with 10 bits";
    case TexelFormat::Half:
        return "half floats";
    }
    return "";
}

vk::ImageRegion regionOf(const ImageTarget& target, VkImageAspectFlags aspect, std::uint32_t texel_bytes,
                         PictureSize size)
{
    if (target.layout != VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL && target.layout != VK_IMAGE_LAYOUT_GENERAL)
    {
        throw Error(ErrorCode::Usage, fmt::format("zvo cannot copy into an image in VkImageLayout {}: bring it into "
                                                  "TRANSFER_DST_OPTIMAL or GENERAL before",
                                                  static_cast<int>(target.layout)));
    }
    if (target.offset.x < 0 || target.offset.y < 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("a picture cannot begin at ({}, {}) of an image: both must be 0 or "
                                                  "more",
                                                  target.offset.x, target.offset.y));
    }
    const auto fits = [](std::int32_t first, std::uint32_t edge, std::uint32_t room)
    { return room == 0 || std::uint64_t{edge} + static_cast<std::uint32_t>(first) <= room; };
    if (!fits(target.offset.x, size.width, target.extent.width) ||
        !fits(target.offset.y, size.height, target.extent.height))
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("a picture of {} x {} pixels at ({}, {}) does not fit into an image of {} x {}",
                                size.width, size.height, target.offset.x, target.offset.y, target.extent.width,
                                target.extent.height));
    }
    return {target.image,     target.layout,     aspect, texel_bytes, target.offset, {size.width, size.height},
            target.mip_level, target.array_layer};
}

} // namespace

TexelFormat texelFormat(VkFormat format)
{
    return entryFor(kColorFormats, format, "a picture").texels;
}

namespace
{

vk::ImageRegion colorRegion(const TraceBuffers& buffers, const ImageTarget& target)
{
    const ColorFormat& format = entryFor(kColorFormats, target.format, "a picture");
    if (format.texels != buffers.texels)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("a picture made as {} cannot be copied into an image in {}, which takes {}: make "
                                "TraceBuffers with the texelFormat() of the image's format",
                                wordsFor(buffers.texels), format.name, wordsFor(format.texels)));
    }
    const std::uint32_t texel_bytes = texelWords(format.texels) * static_cast<std::uint32_t>(sizeof(gpu::uint));
    return regionOf(target, VK_IMAGE_ASPECT_COLOR_BIT, texel_bytes, {buffers.width, buffers.height});
}

vk::ImageRegion depthRegion(PictureSize size, const ImageTarget& target)
{
    const DepthFormat& format = entryFor(kDepthFormats, target.format, "depth");
    return regionOf(target, format.aspect, sizeof(float), size);
}

} // namespace

void copyToImage(vk::FrameGraph& graph, const TraceBuffers& buffers, const ImageTarget& target)
{
    vk::copyToImage(graph, buffers.image, colorRegion(buffers, target));
}

void requireCopyable(const TraceBuffers& buffers, const ImageTarget& target)
{
    colorRegion(buffers, target);
}

void copyDepthToImage(vk::FrameGraph& graph, const vk::BufferOf<float>& depth, PictureSize size,
                      const ImageTarget& target)
{
    vk::copyToImage(graph, depth, depthRegion(size, target));
}

void requireDepthCopyable(const vk::Device& device, PictureSize size, const ImageTarget& target)
{
    vk::requireCopyable(device, depthRegion(size, target).aspect);
}

} // namespace zvo
