// SPDX-License-Identifier: MIT
// Images of a host: with mip levels and layers, in any layout, and with the host's own barriers.
#pragma once

#include "vk/headless.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo::test
{

/// A 2D image that can only be copied from and to. It cannot be moved; tests make it where they use it.
class HostImage
{
public:
    HostImage(vk::HeadlessDevice& device, VkFormat format, VkExtent2D extent, std::uint32_t mip_levels = 1,
              std::uint32_t layers = 1);
    ~HostImage();
    HostImage(const HostImage&) = delete;
    HostImage& operator=(const HostImage&) = delete;

    [[nodiscard]] VkImage handle() const { return m_image; }
    [[nodiscard]] VkExtent2D extentOf(std::uint32_t mip_level) const;
    [[nodiscard]] std::uint32_t texelWords() const;

    /// Records the barrier that comes before a copy, as core/present/image_target.h states it: into layout, keeping the
    /// contents.
    void beginCopies(vk::FrameGraph& graph, VkImageLayout layout);

    /// Records the barrier that comes after copies into the image, before copies from it.
    void endCopies(vk::FrameGraph& graph);

    /// The words of all texels of one mip level and layer, row by row, of color or depth. Waits.
    void upload(std::uint32_t mip_level, std::uint32_t layer, std::span<const gpu::uint> words);
    std::vector<gpu::uint> download(std::uint32_t mip_level, std::uint32_t layer);

private:
    [[nodiscard]] VkBufferImageCopy whole(std::uint32_t mip_level, std::uint32_t layer) const;
    void change(vk::FrameGraph& graph, VkImageLayout layout, VkAccessFlags2 before, VkAccessFlags2 after);

    vk::HeadlessDevice& m_device;
    VkFormat m_format;
    VkExtent2D m_extent;
    VkImage m_image = VK_NULL_HANDLE;
    VkImageLayout m_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    vk::MemoryBlock m_memory;
};

} // namespace zvo::test
