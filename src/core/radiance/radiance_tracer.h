// SPDX-License-Identifier: MIT
#pragma once

#include "core/radiance/radiance_cache.h"
#include "core/radiance/radiance_view.h"
#include "core/trace/tree_tracer.h"

#include <cstdint>
#include <memory>

namespace zvo
{

/// Pictures of the light that is kept on voxels: a frame traces the camera's rays and brings the light up to date. Owns
/// all buffers.
class RadianceTracer
{
public:
    /// deletion_queue: as in TreeTracer.
    explicit RadianceTracer(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr)
        : m_device(device), m_deletion_queue(deletion_queue), m_tracer(device, deletion_queue),
          m_cache(device, deletion_queue)
    {
    }

    /// Sets the size of the pictures, and begins a new one if it is another size. Must be called before the first
    /// frame. Throws Error{Memory}; then all stays as it was.
    void resize(std::uint32_t width, std::uint32_t height);

    /// Makes the buffers that addFrame() needs for a tree. Throws Error{Memory}; then all stays as it was.
    void reserve(const DeviceTree& tree, const RadianceOptions& options);

    /// Begins a new picture with the next frame. The light stays.
    void beginPicture() { m_view->begin(); }

    /// Records the passes of a frame, and adds what the camera sees to the picture: through the middle of the pixels in
    /// its first frame, and through other points of them, the same of each pixel, in the following ones. Throws
    /// Error{Memory}. Cost: pixels, and the rays of options.faces.
    void addFrame(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                  const TraceCamera& camera, const RadianceOptions& options, KeptView kind = KeptView::Faces);

    /// Records the passes of a frame that brings the light up to date and shows none, for as long as there is no
    /// picture. Throws Error{Memory}. Cost: as addFrame(), without what it takes to show light.
    void settle(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                const TraceCamera& camera, const RadianceOptions& options);

    /// Forgets picture and light: because the last frame was lost, or kernels may have changed.
    void forget();

    /// The frames so far.
    [[nodiscard]] SampledPicture picture() const { return m_view->picture(); }

    [[nodiscard]] RadianceCache& cache() { return m_cache; }
    [[nodiscard]] const RadianceCache& cache() const { return m_cache; }
    [[nodiscard]] const TraceBuffers& buffers() const { return m_tracer.buffers(); }

    /// Device memory of all buffers but the node paths'.
    [[nodiscard]] std::uint64_t bytes() const { return m_tracer.buffers().bytes() + m_cache.bytes() + m_view->bytes(); }

private:
    void update(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                const TraceCamera& camera, const RadianceOptions& options);

    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    TreeTracer m_tracer;
    RadianceCache m_cache;
    std::unique_ptr<RadianceView> m_view; // from resize() on
};

} // namespace zvo
