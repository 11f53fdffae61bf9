// SPDX-License-Identifier: MIT
#pragma once

#include "core/trace/trace.h"
#include "vk/deletion_queue.h"

#include <cstdint>
#include <memory>

namespace zvo
{

/// Traces pictures of one tree or another. Owns what a picture takes, and the beam grid, which is made anew where the
/// tree's version (DeviceTree::version) is not the one that it was made of.
class TreeTracer
{
public:
    /// retired gets what frames in flight may use, and outlives this; null: there are none when something is replaced.
    explicit TreeTracer(vk::Device& device, vk::DeletionQueue* deletion_queue = nullptr,
                        TexelFormat texels = TexelFormat::Rgba8)
        : m_device(device), m_deletion_queue(deletion_queue), m_texels(texels)
    {
    }

    /// The size of the next pictures; nothing is traced before it is known. Throws Error{Memory} for pictures that the
    /// device's budget does not allow: the size stays.
    void resize(std::uint32_t width, std::uint32_t height);

    /// Makes the buffers of the beam grid that tree takes, unless they are there. Throws Error{Memory}: then nothing
    /// changes. prepare() begins with this.
    void reserve(const DeviceTree& tree);

    /// Records the passes that make the beam grid of tree, where they are needed (buildBeam()). Both calls below begin
    /// with this one.
    void prepare(vk::FrameGraph& graph, const DeviceTree& tree);

    /// See zvo::tracePrimary() and zvo::trace().
    void tracePrimary(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                      const TraceOptions& options);
    void trace(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options);

    /// The next picture has its beam grid made anew: the last frame was lost, or the kernels may have changed.
    void forget() { m_beam_version = 0; }

    /// What the last picture left.
    [[nodiscard]] const TraceBuffers& buffers() const { return *m_buffers; }

private:
    template <typename T> void replace(std::unique_ptr<T>& old, std::unique_ptr<T> made);

    vk::Device& m_device;
    vk::DeletionQueue* m_deletion_queue;
    TexelFormat m_texels;
    std::unique_ptr<TraceBuffers> m_buffers;
    std::unique_ptr<BeamGrid> m_beam;
    bool m_beam_is_for_dags = false;
    std::uint64_t m_beam_version = 0; // of the tree that it was made of; 0: none
};

} // namespace zvo
