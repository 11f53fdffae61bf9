// SPDX-License-Identifier: MIT
#pragma once

#include "core/trace/trace.h"
#include "vk/deletion_queue.h"

#include <cstdint>
#include <memory>

namespace zvo
{

/// Traces pictures of one tree or several. Owns the buffers of a picture and node paths, which are made anew when the
/// tree's version (DeviceTree::version) is not the one for which they were made.
class TreeTracer
{
public:
    /// deletion_queue receives the buffers that are replaced while frames in flight may use them, and must outlive the
    /// tracer. Null: no frames are in flight whenever a buffer is replaced.
    explicit TreeTracer(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr,
                        TexelFormat texels = TexelFormat::Rgba8)
        : m_device(device), m_deletion_queue(deletion_queue), m_texels(texels)
    {
    }

    /// Sets the size of the next pictures. Must be called before the first one. Throws Error{Memory} when the device's
    /// budget does not suffice; then the size stays as it was.
    void resize(std::uint32_t width, std::uint32_t height);

    /// Makes the buffer of the node paths for tree, unless it exists. prepare() begins with this. Throws
    /// Error{Memory}; then nothing changes.
    void reserve(const DeviceTree& tree);

    /// Records the passes that make the node paths of tree, if they are out of date (buildNodePaths()). The functions
    /// below begin with this one.
    void prepare(vk::FrameGraph& graph, const DeviceTree& tree);

    /// Record what zvo::tracePrimary() and zvo::trace() record.
    void tracePrimary(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                      const TraceOptions& options);
    void trace(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options);

    /// Records what trace() records, for a picture that goes elsewhere.
    void traceTo(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
                 const TexelTarget& target);

    /// Has the node paths made anew for the next picture: because the last frame was lost, or kernels may have changed.
    void forget() { m_paths_version = 0; }

    /// The buffers of the last picture.
    [[nodiscard]] const TraceBuffers& buffers() const { return *m_buffers; }

    /// [pixels * texelWords()] The last picture, for passes that make it in another way.
    [[nodiscard]] vk::BufferOf<gpu::uint>& image() { return m_buffers->image; }

private:
    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    TexelFormat m_texels;
    std::unique_ptr<TraceBuffers> m_buffers;
    std::unique_ptr<NodePaths> m_paths;
    bool m_paths_are_for_dags = false;
    std::uint64_t m_paths_version = 0; // of the tree that m_paths was made of; 0: out of date
};

} // namespace zvo
