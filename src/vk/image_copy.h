// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <cstdint>

namespace zvo::vk
{

class Buffer;
class Device;
class FrameGraph;

/// A rectangle in one mip level and layer of an image that zvo does not own.
struct ImageRegion
{
    VkImage image = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    std::uint32_t texel_bytes = 0; // size of a texel of that aspect in a buffer
    VkOffset2D offset{0, 0};
    VkExtent2D extent{0, 0};
    std::uint32_t mip_level = 0;
    std::uint32_t array_layer = 0;
};

/// Records a pass that fills region with the texels at the beginning of `from`, row by row without gaps. The region
/// must lie within the image, whose usage must include TRANSFER_DST. The pass neither changes layouts nor orders
/// accesses to the image: it writes the image in stage COPY with access TRANSFER_WRITE, and barriers before and after
/// it are up to the caller. Throws Error{Other} when `from` is too small, and Error{Usage} for a depth aspect when the
/// queue family of the device's handles cannot draw, as Vulkan forbids the copy there.
void copyToImage(FrameGraph& graph, const Buffer& from, const ImageRegion& region);

/// Throws the Error{Usage} that copyToImage() would throw.
void requireCopyable(const Device& device, VkImageAspectFlags aspect);

} // namespace zvo::vk
