// SPDX-License-Identifier: MIT
#include "vk/image_copy.h"

#include "vk/device.h"
#include "vk/frame_graph.h"
#include "zvo/error.h"

#include <fmt/format.h>

namespace zvo::vk
{

void requireCopyable(const Device& device, VkImageAspectFlags aspect)
{
    if ((aspect & VK_IMAGE_ASPECT_COLOR_BIT) == 0 && (device.queueFlags() & VK_QUEUE_GRAPHICS_BIT) == 0)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("queue family {} cannot draw, and only those that can copy into depth images: give "
                                "zvo one with VK_QUEUE_GRAPHICS_BIT, or copy depth into an image in R32_SFLOAT",
                                device.handles().queue_family));
    }
}

void copyToImage(FrameGraph& graph, const Buffer& from, const ImageRegion& region)
{
    const Device& device = graph.device();
    const std::uint64_t bytes =
        std::uint64_t{region.extent.width} * region.extent.height * std::uint64_t{region.texel_bytes};
    if (bytes > from.bytes())
    {
        throw Error(ErrorCode::Other,
                    fmt::format("frame graph: {} x {} texels of {} bytes are more than buffer {} has",
                                region.extent.width, region.extent.height, region.texel_bytes, from.name()));
    }
    requireCopyable(device, region.aspect);
    if (bytes == 0)
    {
        return;
    }
    VkBufferImageCopy copy{}; // zeros: rows without gaps
    copy.imageSubresource = {region.aspect, region.mip_level, region.array_layer, 1};
    copy.imageOffset = {region.offset.x, region.offset.y, 0};
    copy.imageExtent = {region.extent.width, region.extent.height, 1};
    graph.record("copy " + from.name() + " to an image", {CopyUse::read(from)},
                 [&](VkCommandBuffer commands) {
                     device.fn().vkCmdCopyBufferToImage(commands, from.handle(), region.image, region.layout, 1, &copy);
                 });
}

} // namespace zvo::vk
