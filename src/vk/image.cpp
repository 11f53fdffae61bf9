// SPDX-License-Identifier: MIT
#include "vk/image.h"

#include "vk/check.h"
#include "vk/device.h"

#include <algorithm>
#include <utility>

namespace zvo::vk
{

// Delegates, so that the destructor cleans up when something below throws.
Image::Image(Device& device, std::string name, std::uint32_t width, std::uint32_t height, VkFormat format,
             VkImageUsageFlags usage, VkFormat view_format)
    : Image()
{
    view_format = view_format == VK_FORMAT_UNDEFINED ? format : view_format;
    m_device = &device;
    m_name = std::move(name);
    m_format = format;
    m_width = width;
    m_height = height;

    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags = view_format != format ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {width, height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    const Functions& fn = device.fn();
    VK_CHECK(fn.vkCreateImage(device.handle(), &info, device.allocationCallbacks(), &m_handle));
    device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(m_handle), m_name);

    VkMemoryRequirements requirements{};
    fn.vkGetImageMemoryRequirements(device.handle(), m_handle, &requirements);
    // The image gets pages of its own, as buffers may lie in the same block of memory.
    const std::uint64_t granularity = std::max<std::uint64_t>(1, device.limits().bufferImageGranularity);
    requirements.alignment = std::max(requirements.alignment, granularity);
    requirements.size = (requirements.size + granularity - 1) / granularity * granularity;
    m_memory = device.memory().allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, m_name.c_str());
    VK_CHECK(fn.vkBindImageMemory(device.handle(), m_handle, m_memory.memory, m_memory.offset));

    // Views are only allowed with some usages. An image that is only copied has no view.
    constexpr VkImageUsageFlags kCopies = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if ((usage & ~kCopies) == 0)
    {
        return;
    }
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = m_handle;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = view_format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VK_CHECK(fn.vkCreateImageView(device.handle(), &view, device.allocationCallbacks(), &m_view));
    device.setName(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<std::uint64_t>(m_view), m_name);
}

Image::~Image()
{
    if (m_handle != VK_NULL_HANDLE)
    {
        const Functions& fn = m_device->fn();
        fn.vkDestroyImageView(m_device->handle(), m_view, m_device->allocationCallbacks());
        fn.vkDestroyImage(m_device->handle(), m_handle, m_device->allocationCallbacks());
        m_device->memory().release(m_memory);
    }
}

Image::Image(Image&& other) noexcept
    : m_device(std::exchange(other.m_device, nullptr)), m_name(std::exchange(other.m_name, {})),
      m_handle(std::exchange(other.m_handle, VK_NULL_HANDLE)), m_view(std::exchange(other.m_view, VK_NULL_HANDLE)),
      m_format(std::exchange(other.m_format, VK_FORMAT_UNDEFINED)), m_width(std::exchange(other.m_width, 0)),
      m_height(std::exchange(other.m_height, 0)), m_memory(std::exchange(other.m_memory, {}))
{
}

Image& Image::operator=(Image&& other) noexcept
{
    Image old(std::move(other));
    std::swap(m_device, old.m_device);
    std::swap(m_name, old.m_name);
    std::swap(m_handle, old.m_handle);
    std::swap(m_view, old.m_view);
    std::swap(m_format, old.m_format);
    std::swap(m_width, old.m_width);
    std::swap(m_height, old.m_height);
    std::swap(m_memory, old.m_memory);
    return *this;
}

} // namespace zvo::vk
