// SPDX-License-Identifier: MIT
#include "support/host_image.h"

#include "vk/check.h"

#include <algorithm>

namespace zvo::test
{

namespace
{

VkImageAspectFlags aspectsOf(VkFormat format)
{
    switch (format)
    {
    case VK_FORMAT_D32_SFLOAT:
        return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
        return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
        return VK_IMAGE_ASPECT_COLOR_BIT;
    }
}

} // namespace

HostImage::HostImage(vk::HeadlessDevice& device, VkFormat format, VkExtent2D extent, std::uint32_t mip_levels,
                     std::uint32_t layers)
    : m_device(device), m_format(format), m_extent(extent)
{
    vk::Device& owner = device.device();
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = mip_levels;
    info.arrayLayers = layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    VK_CHECK(owner.fn().vkCreateImage(owner.handle(), &info, owner.allocationCallbacks(), &m_image));
    VkMemoryRequirements requirements{};
    owner.fn().vkGetImageMemoryRequirements(owner.handle(), m_image, &requirements);
    const std::uint64_t granularity = std::max<std::uint64_t>(1, owner.limits().bufferImageGranularity);
    requirements.alignment = std::max(requirements.alignment, granularity);
    requirements.size = (requirements.size + granularity - 1) / granularity * granularity;
    m_memory = owner.memory().allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, "a host's image");
    VK_CHECK(owner.fn().vkBindImageMemory(owner.handle(), m_image, m_memory.memory, m_memory.offset));
}

HostImage::~HostImage()
{
    vk::Device& owner = m_device.device();
    owner.fn().vkDestroyImage(owner.handle(), m_image, owner.allocationCallbacks());
    owner.memory().release(m_memory);
}

VkExtent2D HostImage::extentOf(std::uint32_t mip_level) const
{
    return {std::max(m_extent.width >> mip_level, 1U), std::max(m_extent.height >> mip_level, 1U)};
}

std::uint32_t HostImage::texelWords() const
{
    return m_format == VK_FORMAT_R16G16B16A16_SFLOAT ? 2 : 1;
}

VkBufferImageCopy HostImage::whole(std::uint32_t mip_level, std::uint32_t layer) const
{
    const VkExtent2D extent = extentOf(mip_level);
    const VkImageAspectFlags aspect = aspectsOf(m_format) & ~VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT};
    VkBufferImageCopy region{};
    region.imageSubresource = {aspect, mip_level, layer, 1};
    region.imageExtent = {extent.width, extent.height, 1};
    return region;
}

void HostImage::change(vk::FrameGraph& graph, VkImageLayout layout, VkAccessFlags2 before, VkAccessFlags2 after)
{
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.srcAccessMask = before;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstAccessMask = after;
    barrier.oldLayout = m_layout;
    barrier.newLayout = layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = m_image;
    barrier.subresourceRange = {aspectsOf(m_format), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    graph.record("the host's barrier", {},
                 [&](VkCommandBuffer commands)
                 { m_device.device().fn().vkCmdPipelineBarrier2(commands, &dependency); });
    m_layout = layout;
}

void HostImage::beginCopies(vk::FrameGraph& graph, VkImageLayout layout)
{
    change(graph, layout, VK_ACCESS_2_NONE,
           VK_ACCESS_2_TRANSFER_WRITE_BIT); // waits for reads, and makes writes visible
}

void HostImage::endCopies(vk::FrameGraph& graph)
{
    change(graph, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
}

void HostImage::upload(std::uint32_t mip_level, std::uint32_t layer, std::span<const gpu::uint> words)
{
    const vk::BufferOf<gpu::uint> source = m_device.makeBuffer("texels", words);
    const VkBufferImageCopy region = whole(mip_level, layer);
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            beginCopies(graph, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
            graph.record("upload to the host's image", {vk::CopyUse::read(source)},
                         [&](VkCommandBuffer commands) {
                             m_device.device().fn().vkCmdCopyBufferToImage(commands, source.handle(), m_image, m_layout,
                                                                           1, &region);
                         });
            endCopies(graph);
        });
}

std::vector<gpu::uint> HostImage::download(std::uint32_t mip_level, std::uint32_t layer)
{
    const VkExtent2D extent = extentOf(mip_level);
    vk::BufferOf<gpu::uint> target(m_device.device(), "texels",
                                   std::uint64_t{extent.width} * extent.height * texelWords());
    const VkBufferImageCopy region = whole(mip_level, layer);
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            graph.record("download of the host's image", {vk::CopyUse::write(target)},
                         [&](VkCommandBuffer commands) {
                             m_device.device().fn().vkCmdCopyImageToBuffer(commands, m_image, m_layout, target.handle(),
                                                                           1, &region);
                         });
        });
    return m_device.download(target);
}

} // namespace zvo::test
