// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace zvo
{

/// Where in a host's image a picture goes.
struct ImageTarget
{
    VkImage image = VK_NULL_HANDLE; // of one sample a texel
    VkFormat format = VK_FORMAT_UNDEFINED;
    // The layout that the image has when the copy runs: TRANSFER_DST_OPTIMAL or GENERAL.
    VkImageLayout layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    VkOffset2D offset{0, 0}; // of the picture's top left pixel in the mip level, which has room for all of it
    std::uint32_t mip_level = 0;
    std::uint32_t array_layer = 0;
    VkExtent2D extent{0, 0}; // of the mip level: the picture must fit; 0: zvo does not check that
};

} // namespace zvo
