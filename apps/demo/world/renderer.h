// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "core/trace/tree_tracer.h"
#include "demo/world/compose.h"
#include "demo/world/view_state.h"
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
    ViewState view;
    PictureSize window;                            // in pixels
    PictureSize internal;                          // that is traced
    std::function<void(VkCommandBuffer)> panels;   // draws over the picture; may be empty
    const vk::SwapchainImage* target = nullptr;    // null: it is not shown
    vk::BufferOf<gpu::uint>* screenshot = nullptr; // gets the window's pixels; may be null
    bool screenshot_has_panels = true;
    std::optional<glm::uvec2> inspected;              // pixel of the window
    vk::BufferOf<gpu::PixelReport>* report = nullptr; // gets what is there
};

/// Records frames: from the world's tree to the image of the swapchain. Its buffers follow the sizes that are asked
/// for; old ones go when the device is done with their frames.
class Renderer
{
public:
    Renderer(vk::HeadlessDevice& device, const ComposePass& pass)
        : m_device(device), m_pass(pass), m_tracer(device.device(), &m_deletion_queue)
    {
    }

    /// The frame with this number begins, upwards; it shows tree. encodes_srgb: of the swapchain's format. Throws
    /// Error{Memory} for pictures that the device's budget does not allow: then the last ones stay.
    void begin(std::uint64_t frame, const DeviceTree& tree, const Picture& picture, bool encodes_srgb);

    /// Records it, of a tree.
    void record(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture);

    /// The device is done with that frame and all before it.
    void frameDone(std::uint64_t frame) { m_deletion_queue.frameDone(frame); }

    /// The frame that began last does not reach the device, or the kernels may have changed: what they make for tracing
    /// is made again.
    void forget() { m_tracer.forget(); }

    /// Device memory of the picture on its way.
    [[nodiscard]] std::uint64_t pictureBytes() const;

    /// Primary rays of a frame.
    [[nodiscard]] std::uint64_t rayCount() const { return primaryRayCount(m_tracer.buffers()); }

private:
    vk::HeadlessDevice& m_device;
    const ComposePass& m_pass;
    vk::DeletionQueue m_deletion_queue;
    TreeTracer m_tracer;
    std::unique_ptr<ComposeImage> m_compose;
};

} // namespace zvo::demo
