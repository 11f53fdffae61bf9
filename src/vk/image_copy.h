// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <cstdint>

namespace zvo::vk
{

class Buffer;
class Device;
class FrameGraph;

/// A rectangle in one mip level and layer of an image that somebody else owns.
struct ImageRegion
{
    VkImage image = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    std::uint32_t texel_bytes = 0; // of that aspect, as buffers hold it
    VkOffset2D offset{0, 0};
    VkExtent2D extent{0, 0};
    std::uint32_t mip_level = 0;
    std::uint32_t array_layer = 0;
};

/// Records a pass that fills region with the texels at the beginning of from, row by row without gaps. The region lies
/// within the image, whose usage has TRANSFER_DST. Neither changes layouts nor orders accesses to the image: the copy
/// writes it in stage COPY with access TRANSFER_WRITE, and what comes before and after is the caller's affair. Throws
/// Error{Other} when from is too small, and Error{Usage} for a depth aspect when the queue family of the device's
/// handles cannot draw, without which Vulkan forbids the copy.
void copyToImage(FrameGraph& graph, const Buffer& from, const ImageRegion& region);

/// Throws Error{Usage} as copyToImage() does.
void requireCopyable(const Device& device, VkImageAspectFlags aspect);

} // namespace zvo::vk
