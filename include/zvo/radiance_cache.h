// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/dynamic_tree.h"
#include "zvo/export.h"
#include "zvo/light.h"
#include "zvo/tracer.h"
#include "zvo/tree.h"

#include <cstdint>
#include <memory>

namespace zvo
{

/// What light is cached for.
struct RadianceCacheInfo
{
    // The rays of a camera that find which faces of voxels it sees, 1 to 16384 along each edge, in the proportion of
    // the host's picture. They go through other points of their pixels in each frame: a quarter of the picture's edges
    // suffices.
    std::uint32_t width = 160;
    std::uint32_t height = 90;

    // The most faces that are kept, up to 2^29, with the bricks around them; 0: as many as memory has room for. Those
    // that no ray has hit for longest make room.
    std::uint64_t faces = 0;
};

/// Options of a frame.
struct CachedFrameInfo
{
    std::uint32_t rays = 1U << 14; // the most faces that get a sample: up to two rays and two shadow rays; 1 to 2^22
    std::uint32_t seed = 0;        // of the random numbers
};

/// Counts of a radiance cache, known once a frame is done.
struct RadianceCacheStats
{
    std::uint64_t faces = 0;   // with light
    std::uint64_t refused = 0; // faces for which there was no room, each time that a ray has hit them
    std::uint64_t room = 0;    // for faces and bricks, in the table as it is
    bool is_crowded = false;   // there would be more room if RadianceCacheInfo::faces, or memory, allowed it
};

/// A world-space radiance cache: light on the faces of voxels, which gets better from frame to frame
/// (docs/radiance.md), for the host's own shaders. zvo/trace.glsl looks it up at any point of a surface, without a ray
/// (docs/host-glsl.md). It follows what moves, brushes, the sun and lamps by itself. All frames in flight may use it.
/// Move-only; throws Error{Usage} when it is used after it was moved from.
class ZVO_API RadianceCache
{
public:
    /// Memory: 28 bytes for each ray of the camera, and 18 MB. Throws Error{Usage} for numbers out of range, and
    /// Error{Memory}.
    explicit RadianceCache(Context& context, const RadianceCacheInfo& info = {});
    ~RadianceCache();
    RadianceCache(RadianceCache&&) noexcept;
    RadianceCache& operator=(RadianceCache&&) noexcept;

    /// Records the passes of a frame: the camera's rays, then samples for faces that it sees and for those that rays of
    /// the frame before have hit. Light arrives by one reflection more with each frame. The same calls give the same
    /// light on every device.
    ///
    /// The light stays while trees change: light that a change touches is made anew within some frames, which update()
    /// sees by itself. In another grid than that of the last call, all begins anew; so it does after a call that failed
    /// or whose frame was lost. The environment must live for as long as shaders read.
    ///
    /// Memory, from the first call on: 36 bytes for each face and brick that there is room for, at first for what a
    /// frame may find. When rays find more, faces make room, or what moves has left some, faces move into another
    /// table, and both are there for a frame. Besides, about 200 bytes for each of the rays, and what
    /// Tracer::tracePaths() takes for lights of the tree. First stages: ALL_TRANSFER, COMPUTE_SHADER and DRAW_INDIRECT;
    /// last stages: COMPUTE_SHADER and ALL_TRANSFER; on resources of zvo. Before the host's shaders read:
    /// Recorder::makeVisible(); before the next call: readers of its Recorder. Cost: the camera's rays, and up to two
    /// rays and two shadow rays for each face that is sampled.
    ///
    /// Throws Error{Usage} for cameras that are not valid, for numbers out of range, and for an environment or a tree
    /// that was lost; then nothing is recorded. Throws Error{Memory}, and what making a kernel throws; then shaders
    /// find no light until the next call.
    void update(Recorder& recorder, const Tree& tree, Environment& environment, const CameraInfo& camera,
                const CachedFrameInfo& info = {});
    void update(Recorder& recorder, DynamicTree& tree, Environment& environment, const CameraInfo& camera,
                const CachedFrameInfo& info = {});

    /// The address of a table for the host's shaders (zvo_RadianceCacheTable), which stays the same however the light
    /// is moved. What it says means nothing before the first update() that reaches the device.
    [[nodiscard]] std::uint64_t address() const;

    /// Has the next update() begin anew, such as in another scene. Records nothing: shaders see what was kept until
    /// then.
    void forget();

    /// Counts of the newest update() whose frame is done.
    [[nodiscard]] RadianceCacheStats stats();

    /// Device memory of all buffers.
    [[nodiscard]] std::uint64_t bytes() const;

    struct Impl;
    [[nodiscard]] Impl* impl() const { return m_impl.get(); } // only for the library; null after a move

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
