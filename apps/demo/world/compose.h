// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "core/trace/trace.h"
#include "vk/headless.h"
#include "vk/image.h"
#include "vk/swapchain.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace zvo::demo
{

/// How what is drawn over pictures goes into a ComposeImage: a render pass for others' pipelines.
class ComposePass
{
public:
    /// The picture's bytes are sRGB codes, which blend as they are.
    static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

    explicit ComposePass(vk::Device& device);
    ~ComposePass();
    ComposePass(const ComposePass&) = delete;
    ComposePass& operator=(const ComposePass&) = delete;

    [[nodiscard]] VkRenderPass handle() const { return m_handle; }

private:
    vk::Device& m_device;
    VkRenderPass m_handle = VK_NULL_HANDLE;
};

/// The image that a window shows, before it goes to the swapchain: the picture in the window's size, and what is drawn
/// over it. A frame records fill(), drawOver(), copyTo() and show() in this order, as far as it needs them.
class ComposeImage
{
public:
    /// encodes_srgb: of the swapchain's format, to which the bytes go as they are. pass must outlive this.
    ComposeImage(vk::Device& device, const ComposePass& pass, PictureSize size, bool encodes_srgb);
    ~ComposeImage();
    ComposeImage(const ComposeImage&) = delete;
    ComposeImage& operator=(const ComposeImage&) = delete;

    [[nodiscard]] PictureSize size() const { return m_size; }
    [[nodiscard]] bool encodesSrgb() const { return m_encodes_srgb; }

    /// Device memory that it takes.
    [[nodiscard]] std::uint64_t bytes() const { return m_image.bytes() + m_scaled.bytes(); }

    /// Records the passes that put a picture there, in any size.
    void fill(vk::FrameGraph& graph, const TraceBuffers& picture);

    /// Records the pass in which draw draws over the picture, within the render pass.
    void drawOver(vk::FrameGraph& graph, const std::function<void(VkCommandBuffer)>& draw);

    /// Records the copy to a buffer of as many words as there are pixels: red | green << 8 | blue << 16 | alpha << 24.
    void copyTo(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& pixels);

    /// Records the pass that brings it to an image of the swapchain.
    void show(vk::FrameGraph& graph, const vk::SwapchainImage& target);

private:
    vk::Device& m_device;
    const ComposePass& m_pass;
    PictureSize m_size;
    bool m_encodes_srgb;
    vk::Image m_image;
    vk::BufferOf<gpu::uint> m_scaled; // empty until a picture of another size comes
    VkFramebuffer m_framebuffer = VK_NULL_HANDLE;
};

} // namespace zvo::demo
