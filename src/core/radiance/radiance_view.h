// SPDX-License-Identifier: MIT
#pragma once

#include "core/path/develop.h"
#include "core/radiance/device_radiance_cache.h"

#include <cstdint>

namespace zvo
{

/// How a picture shows the radiance cache.
enum class CacheView : std::uint8_t
{
    Faces,  ///< that of the faces that are seen
    Cones,  ///< what comes to them through six cones (C. Crassin et al., 2011), to compare with
    Smooth, ///< that of the voxels that are seen, by their normals: slopes of steps look like planes
};

/// A picture by the radiance cache. Owns its buffers.
class RadianceView
{
public:
    /// Throws Error{Memory}.
    RadianceView(vk::Device& device, std::uint32_t width, std::uint32_t height);

    /// Begins a new picture with the next frame.
    void begin() { m_frame_count = 0; }

    /// Records the passes that add what the camera sees, by the radiance cache and directly, to the picture. cache:
    /// after its update() for the same tree and environment. seen: filled by tracePrimary() of the tree, without a
    /// level of detail, in the picture's size. Cost: pixels; for CacheView::Cones, six cones and a ray to the sun for
    /// each, which follow their rays in one dispatch, however long.
    void add(vk::FrameGraph& graph, const DeviceRadianceCache& cache, const DeviceTree& tree,
             const DeviceEnvironment& environment, const TraceCamera& camera, const TraceBuffers& seen,
             CacheView kind = CacheView::Smooth, std::uint32_t seed = 0);

    /// Frames so far.
    [[nodiscard]] std::uint32_t frameCount() const { return m_frame_count; }

    /// The frames so far.
    [[nodiscard]] SampledPicture picture() const { return {m_sums, m_width, m_height, m_frame_count}; }

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const { return m_sums.bytes() + m_direct.bytes() + m_lists.bytes(); }

private:
    struct Work;

    void addCached(vk::FrameGraph& graph, const Work& work);
    void addCone(vk::FrameGraph& graph, const Work& work, std::uint32_t cone, std::uint32_t seed);
    void addDirect(vk::FrameGraph& graph, const Work& work);

    std::uint32_t m_width;
    std::uint32_t m_height;
    vk::BufferOf<gpu::PixelSum> m_sums;      // [pixels] in the order of shaders/path/path.h
    vk::BufferOf<gpu::uint> m_direct;        // [pixels] numbers of those that see light directly
    vk::BufferOf<gpu::DispatchArgs> m_lists; // [kListElements]
    std::uint32_t m_frame_count = 0;
};

} // namespace zvo
