// SPDX-License-Identifier: MIT
#pragma once

#include "core/frame/frame_renderer.h"
#include "core/present/present.h"
#include "demo/world/compose.h"
#include "demo/world/pixel_probe.h"
#include "vk/deletion_queue.h"
#include "vk/headless.h"
#include "vk/swapchain.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace zvo::demo
{

/// A frame's picture.
struct Picture
{
    ViewCamera camera;
    FrameOptions options;
    PictureSize window;                            // in pixels
    PictureSize internal;                          // size of the traced picture
    std::function<void(VkCommandBuffer)> panels;   // draws over the picture; may be empty
    const vk::SwapchainImage* target = nullptr;    // null: the picture is not shown
    vk::BufferOf<gpu::uint>* screenshot = nullptr; // gets the window's pixels; may be null
    bool screenshot_has_panels = true;
    PixelProbe* probe = nullptr; // finds what the rays of single pixels meet; may be null
    /// Gets what tells how many rays the paths have (rayCountOf()), [Renderer::rayListElements()]; may be null.
    vk::BufferOf<gpu::DispatchArgs>* ray_lists = nullptr;
    bool edited = false; // brushes have changed voxels in this frame
};

/// Records frames, from the world's tree to the image of the swapchain. Its buffers are made for the requested sizes;
/// old ones are freed when the device is done with their frames.
class Renderer
{
public:
    Renderer(vk::HeadlessDevice& device, const ComposePass& pass)
        : m_device(device), m_pass(pass), m_renderer(device.device(), &m_deletion_queue), m_sky(device.device())
    {
    }

    /// Begins a frame, which shows tree; numbers must rise. encodes_srgb: whether the swapchain's format does. Throws
    /// Error{Memory} if the device's budget does not allow the picture's buffers; the last ones stay then.
    void begin(std::uint64_t frame, const DeviceTree& tree, const Picture& picture, bool encodes_srgb);

    /// Records the frame.
    void record(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture);

    /// The device is done with that frame and all before it.
    void frameDone(std::uint64_t frame) { m_deletion_queue.frameDone(frame); }

    /// Drops what kernels have made for tracing, which is then made again. Called if the last frame is lost, or kernels
    /// may have changed.
    void forget();

    /// Device memory for the picture.
    [[nodiscard]] std::uint64_t pictureBytes() const;

    /// Samples of each pixel of the picture, where it is path traced.
    [[nodiscard]] std::optional<std::uint32_t> sampleCount() const;

    /// Frames of the radiance cache, where there is one.
    [[nodiscard]] std::optional<std::uint32_t> cacheFrames() const;

    /// Elements of the lists of the rays of the frame that was begun; 0 where it is not path traced.
    [[nodiscard]] std::uint64_t rayListElements() const { return m_renderer.rayListElements(m_options); }

    /// Primary rays of a frame.
    [[nodiscard]] std::uint64_t rayCount() const { return primaryRayCount(m_renderer.buffers()); }

    /// Of the last frame's picture.
    [[nodiscard]] Integrator integrator() const { return m_options.shownIntegrator(); }

private:
    vk::HeadlessDevice& m_device;
    const ComposePass& m_pass;
    vk::DeletionQueue m_deletion_queue;
    FrameRenderer m_renderer;
    FrameOptions m_options; // of the last frame
    DeviceEnvironment m_sky;
    std::unique_ptr<ComposeImage> m_compose;
};

} // namespace zvo::demo
