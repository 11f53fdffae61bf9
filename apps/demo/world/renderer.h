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
#include <utility>
#include <vector>

namespace zvo::demo
{

/// What is traced.
struct Picture
{
    ViewCamera camera;
    FrameOptions options;
    PictureSize size;
    PictureSize window;          // in which it is shown
    bool has_sun = true;         // of paths and cached light
    PixelProbe* probe = nullptr; // finds what the rays of single pixels meet; may be null
    /// Gets what tells how many rays the paths have (rayCountOf()), [Renderer::rayListElements()]; may be null.
    vk::BufferOf<gpu::DispatchArgs>* ray_lists = nullptr;
    bool edited = false; // brushes have changed voxels in this frame
};

/// What the window shows around the picture.
struct Composition
{
    PictureSize window;                            // in pixels
    bool encodes_srgb = false;                     // whether the swapchain's format does
    std::function<void(VkCommandBuffer)> panels;   // draws over the picture; may be empty
    const vk::SwapchainImage* target = nullptr;    // null: the picture is not shown
    vk::BufferOf<gpu::uint>* screenshot = nullptr; // gets the window's pixels; may be null
    bool screenshot_has_panels = true;
};

/// Records frames, from the world's tree to the image of the swapchain. While the picture changes, a frame traces it
/// and shows it. A picture that stands still is traced sample by sample, and meanwhile frames show the last one that
/// was kept. Buffers are made for the requested sizes; old ones are freed when the device is done with their frames.
class Renderer
{
public:
    Renderer(vk::HeadlessDevice& device, const ComposePass& pass)
        : m_device(device), m_pass(pass), m_renderer(device.device(), &m_deletion_queue), m_sky(device.device())
    {
    }

    /// Begins a frame; numbers must rise. Throws Error{Memory} if the device's budget does not allow the window's
    /// image; the last one stays then.
    void beginFrame(std::uint64_t frame, const Composition& composition);

    /// Makes the buffers of a picture of tree. Throws Error{Memory}; the last ones stay then.
    void reserve(const DeviceTree& tree, const Picture& picture);

    /// Records the picture, from the first sample on.
    void recordPicture(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture);

    /// Records one more sample of the picture, and develops it.
    void recordSample(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture);

    /// Records how the samples so far look with other options of their development.
    void recordDevelopment(vk::FrameGraph& graph, const FrameOptions& options);

    /// Records what the picture's probe finds in the picture that was traced last.
    void recordProbe(vk::FrameGraph& graph, const DeviceTree& tree, const Picture& picture);

    /// Begins a new picture with the next sample. Paths begin anew by themselves.
    void beginPicture();

    /// Records the copy of the last picture that frames show from now on, whatever is traced, until showTraced().
    void keepPicture(vk::FrameGraph& graph);

    /// Records a picture of one colour to be shown, packed as gpu::kTexelRgba8.
    void keepColor(vk::FrameGraph& graph, gpu::uint color);

    /// Has frames show what was traced last.
    void showTraced() { m_shows_kept = false; }

    /// The last picture that was traced: its size, its pixels as gpu::kTexelRgba8 row by row, and its mean radiance,
    /// which only pictures of samples have: Throws Error{Usage} for others. The device must be done with all frames.
    [[nodiscard]] PictureSize pictureSize() const;
    [[nodiscard]] std::vector<gpu::uint> pixels() const;
    [[nodiscard]] HdrImage radiance() const;

    /// Records what the window shows.
    void recordFrame(vk::FrameGraph& graph, const Composition& composition);

    /// The device is done with that frame and all before it.
    void frameDone(std::uint64_t frame) { m_deletion_queue.frameDone(frame); }

    /// Drops what kernels have made for tracing, which is then made again. Called if the last frame is lost, or kernels
    /// may have changed.
    void forget();

    /// Lights pictures by another sky. The device must be done with all frames.
    void setSky(DeviceEnvironment sky) { m_sky = std::move(sky); }

    /// Device memory for the picture.
    [[nodiscard]] std::uint64_t pictureBytes() const;

    /// Samples of each pixel of the last picture.
    [[nodiscard]] std::uint32_t sampleCount() const { return m_sample_count; }

    /// Frames of the radiance cache, where there is one.
    [[nodiscard]] std::optional<std::uint32_t> cacheFrames() const;

    /// Changes with the light of sun and sky.
    [[nodiscard]] std::uint64_t skyVersion() const { return m_sky.version(); }

    /// Elements of the lists of the rays of the picture; 0 where it is not path traced.
    [[nodiscard]] std::uint64_t rayListElements() const { return m_renderer.rayListElements(m_options); }

    /// Primary rays of a sample.
    [[nodiscard]] std::uint64_t rayCount() const { return primaryRayCount(m_renderer.buffers()); }

    /// Of the last picture.
    [[nodiscard]] Integrator integrator() const { return m_options.shownIntegrator(); }

private:
    void probe(vk::FrameGraph& graph, const FrameSubject& subject, const Picture& picture);
    FrameSubject begin(const DeviceTree& tree, const TraceCamera& camera, const Picture& picture);
    void makeKept(PictureSize size);

    vk::HeadlessDevice& m_device;
    const ComposePass& m_pass;
    vk::DeletionQueue m_deletion_queue;
    FrameRenderer m_renderer;
    FrameOptions m_options; // of the last picture
    std::uint32_t m_sample_count = 0;
    bool m_has_buffers = false; // of a picture
    bool m_has_hits = false;    // of primary rays of the last picture
    DeviceEnvironment m_sky;
    std::unique_ptr<ComposeImage> m_compose;
    vk::BufferOf<gpu::uint> m_kept; // a picture of m_kept_size
    PictureSize m_kept_size;
    bool m_shows_kept = false;
};

} // namespace zvo::demo
