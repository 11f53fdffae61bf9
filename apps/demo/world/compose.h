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

/// The render pass that draws over pictures in a ComposeImage, for pipelines of others.
class ComposePass
{
public:
    /// The picture's bytes are sRGB codes. They are blended without decoding.
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

/// The image of the window before it goes to the swapchain: the picture in the window's size, and the panels over it. A
/// frame records fill(), drawOver(), copyTo() and show() in this order; those that it does not need are left out.
class ComposeImage
{
public:
    /// encodes_srgb: whether the swapchain's format does, to which the bytes are copied unchanged. pass must outlive
    /// this.
    ComposeImage(vk::Device& device, const ComposePass& pass, PictureSize size, bool encodes_srgb);
    ~ComposeImage();
    ComposeImage(const ComposeImage&) = delete;
    ComposeImage& operator=(const ComposeImage&) = delete;

    [[nodiscard]] PictureSize size() const { return m_size; }
    [[nodiscard]] bool encodesSrgb() const { return m_encodes_srgb; }

    /// Device memory of the image.
    [[nodiscard]] std::uint64_t bytes() const { return m_image.bytes() + m_scaled.bytes(); }

    /// Records the passes that put a picture of any size into the image.
    void fill(vk::FrameGraph& graph, const vk::BufferOf<gpu::uint>& picture, PictureSize from);

    /// Records the render pass in which draw draws over the picture.
    void drawOver(vk::FrameGraph& graph, const std::function<void(VkCommandBuffer)>& draw);

    /// Records the copy to a buffer with a word for each pixel: red | green << 8 | blue << 16 | alpha << 24.
    void copyTo(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& pixels);

    /// Records the pass that blits it to an image of the swapchain.
    void show(vk::FrameGraph& graph, const vk::SwapchainImage& target);

private:
    vk::Device& m_device;
    const ComposePass& m_pass;
    PictureSize m_size;
    bool m_encodes_srgb;
    vk::Image m_image;
    vk::BufferOf<gpu::uint> m_scaled; // empty until a picture has another size than the window
    VkFramebuffer m_framebuffer = VK_NULL_HANDLE;
};

} // namespace zvo::demo
