// SPDX-License-Identifier: MIT
#pragma once

#include "vk/memory.h"

#include <cstdint>
#include <string>

namespace zvo::vk
{

class Device;

/// A 2D image with one mip level that kernels write as a storage image and that copies to a buffer or a swapchain.
class Image
{
public:
    Image() = default;

    /// Makes an image of width x height pixels in `format`. Its contents are undefined and its layout is
    /// VK_IMAGE_LAYOUT_UNDEFINED. Unless usage is only copies it gets a view, in `format` or in another format of the
    /// same size. Throws Error{Memory} when the device's budget does not suffice.
    Image(Device& device, std::string name, std::uint32_t width, std::uint32_t height, VkFormat format,
          VkImageUsageFlags usage, VkFormat view_format = VK_FORMAT_UNDEFINED);
    ~Image();
    Image(Image&& other) noexcept;
    Image& operator=(Image&& other) noexcept;

    [[nodiscard]] VkImage handle() const { return m_handle; }
    [[nodiscard]] VkImageView view() const { return m_view; }
    [[nodiscard]] VkFormat format() const { return m_format; }
    [[nodiscard]] std::uint32_t width() const { return m_width; }
    [[nodiscard]] std::uint32_t height() const { return m_height; }
    [[nodiscard]] std::uint64_t bytes() const { return m_memory.bytes; } // of its memory
    [[nodiscard]] const std::string& name() const { return m_name; }

private:
    Device* m_device = nullptr;
    std::string m_name;
    VkImage m_handle = VK_NULL_HANDLE;
    VkImageView m_view = VK_NULL_HANDLE;
    VkFormat m_format = VK_FORMAT_UNDEFINED;
    std::uint32_t m_width = 0;
    std::uint32_t m_height = 0;
    MemoryBlock m_memory;
};

} // namespace zvo::vk
