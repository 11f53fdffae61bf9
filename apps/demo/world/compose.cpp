// SPDX-License-Identifier: MIT
#include "demo/world/compose.h"

#include "vk/check.h"

namespace zvo::demo
{

namespace
{

// The image's layout between passes.
constexpr VkImageLayout kRestLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;

struct Use
{
    VkImageLayout layout;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 accesses;
};

constexpr Use kNothing = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_NONE};
constexpr Use kCopiedTo = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                           VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr Use kCopiedFrom = {kRestLayout, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr Use kDrawnTo = {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                          VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr Use kPresented = {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};

constexpr VkImageSubresourceLayers kLayers = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

void change(const vk::Device& device, VkCommandBuffer commands, VkImage image, const Use& from, const Use& to)
{
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = from.stages;
    barrier.srcAccessMask = from.accesses;
    barrier.dstStageMask = to.stages;
    barrier.dstAccessMask = to.accesses;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    device.fn().vkCmdPipelineBarrier2(commands, &dependency);
}

VkBufferImageCopy wholePicture(PictureSize size)
{
    VkBufferImageCopy region{};
    region.imageSubresource = kLayers;
    region.imageExtent = {size.width, size.height, 1};
    return region;
}

} // namespace

ComposePass::ComposePass(vk::Device& device) : m_device(device)
{
    VkAttachmentDescription attachment{};
    attachment.format = kFormat;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = kDrawnTo.layout;
    attachment.finalLayout = kDrawnTo.layout;
    const VkAttachmentReference reference = {0, kDrawnTo.layout};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VK_CHECK(device.fn().vkCreateRenderPass(device.handle(), &info, device.allocationCallbacks(), &m_handle));
    device.setName(VK_OBJECT_TYPE_RENDER_PASS, reinterpret_cast<std::uint64_t>(m_handle), "compose");
}

ComposePass::~ComposePass()
{
    m_device.fn().vkDestroyRenderPass(m_device.handle(), m_handle, m_device.allocationCallbacks());
}

ComposeImage::ComposeImage(vk::Device& device, const ComposePass& pass, PictureSize size, bool encodes_srgb)
    : m_device(device), m_pass(pass), m_size(size), m_encodes_srgb(encodes_srgb),
      // Blits between two formats that encode sRGB keep the bytes. Draws use a view of another format, as they must not
      // decode them.
      m_image(device, "compose", size.width, size.height, encodes_srgb ? VK_FORMAT_R8G8B8A8_SRGB : ComposePass::kFormat,
              VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
              ComposePass::kFormat)
{
    const VkImageView view = m_image.view();
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass.handle();
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = size.width;
    info.height = size.height;
    info.layers = 1;
    VK_CHECK(device.fn().vkCreateFramebuffer(device.handle(), &info, device.allocationCallbacks(), &m_framebuffer));
    device.setName(VK_OBJECT_TYPE_FRAMEBUFFER, reinterpret_cast<std::uint64_t>(m_framebuffer), "compose");
}

ComposeImage::~ComposeImage()
{
    m_device.fn().vkDestroyFramebuffer(m_device.handle(), m_framebuffer, m_device.allocationCallbacks());
}

void ComposeImage::fill(vk::FrameGraph& graph, const vk::BufferOf<gpu::uint>& picture, PictureSize from)
{
    const vk::BufferOf<gpu::uint>* pixels = &picture;
    if (from != m_size)
    {
        if (m_scaled.count() == 0)
        {
            m_scaled = {m_device, "scaled picture", std::uint64_t{m_size.width} * m_size.height};
        }
        scalePicture(graph, picture, from, m_scaled, m_size);
        pixels = &m_scaled;
    }
    graph.record("present/compose", {vk::CopyUse::read(*pixels)},
                 [&](VkCommandBuffer commands)
                 {
                     change(m_device, commands, m_image.handle(), kNothing, kCopiedTo);
                     const VkBufferImageCopy region = wholePicture(m_size);
                     m_device.fn().vkCmdCopyBufferToImage(commands, pixels->handle(), m_image.handle(),
                                                          kCopiedTo.layout, 1, &region);
                     change(m_device, commands, m_image.handle(), kCopiedTo, kCopiedFrom);
                 });
}

void ComposeImage::drawOver(vk::FrameGraph& graph, const std::function<void(VkCommandBuffer)>& draw)
{
    graph.record("present/panels", {},
                 [&](VkCommandBuffer commands)
                 {
                     change(m_device, commands, m_image.handle(), kCopiedFrom, kDrawnTo);
                     VkRenderPassBeginInfo begin{};
                     begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
                     begin.renderPass = m_pass.handle();
                     begin.framebuffer = m_framebuffer;
                     begin.renderArea.extent = {m_size.width, m_size.height};
                     m_device.fn().vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
                     draw(commands);
                     m_device.fn().vkCmdEndRenderPass(commands);
                     change(m_device, commands, m_image.handle(), kDrawnTo, kCopiedFrom);
                 });
}

void ComposeImage::copyTo(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& pixels)
{
    graph.record("present/screenshot", {vk::CopyUse::write(pixels)},
                 [&](VkCommandBuffer commands)
                 {
                     const VkBufferImageCopy region = wholePicture(m_size);
                     m_device.fn().vkCmdCopyImageToBuffer(commands, m_image.handle(), kRestLayout, pixels.handle(), 1,
                                                          &region);
                 });
}

void ComposeImage::show(vk::FrameGraph& graph, const vk::SwapchainImage& target)
{
    graph.record("present/show", {},
                 [&](VkCommandBuffer commands)
                 {
                     change(m_device, commands, target.image, kNothing, kCopiedTo);
                     const auto corner = [](std::uint32_t x, std::uint32_t y) {
                         return VkOffset3D{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), 1};
                     };
                     VkImageBlit region{};
                     region.srcSubresource = kLayers;
                     region.srcOffsets[1] = corner(m_size.width, m_size.height);
                     region.dstSubresource = kLayers;
                     region.dstOffsets[1] = corner(target.extent.width, target.extent.height);
                     m_device.fn().vkCmdBlitImage(commands, m_image.handle(), kRestLayout, target.image,
                                                  kCopiedTo.layout, 1, &region, VK_FILTER_NEAREST);
                     change(m_device, commands, target.image, kCopiedTo, kPresented);
                 });
}

} // namespace zvo::demo
