// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/dynamic_tree.h"
#include "zvo/export.h"
#include "zvo/image_target.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <memory>

namespace zvo
{

/// Where a picture is taken from, in world space. Pixels are square.
struct CameraInfo
{
    DVec3 position = {0, 0, 0};
    DVec3 forward = {0, 0, -1}; // any length; up need not be orthogonal to it
    DVec3 up = {0, 1, 0};
    bool orthographic = false;
    double vertical_fov = 0.7; // radians, inside (0, pi); perspective
    double half_height = 1.0;  // world units; orthographic

    /// From eye towards target, with y up (z for a view straight up or down): as `zvo render --camera`,
    /// where the field of view is in degrees.
    [[nodiscard]] static ZVO_API CameraInfo lookAt(const DVec3& eye, const DVec3& target, double vertical_fov);
};

/// What a picture shows, and how.
struct TraceInfo
{
    View view = View::Color;
    bool shadows = true;               // View::Color: a ray to the sun
    DVec3 to_sun = {-0.6, 0.75, 0.45}; // direction, any length
    float sun = 2.2F;                  // strength
    float exposure = 1.0F;
    std::uint32_t occlusion_rays = 0; // View::Color: for each hit, to find how much of the sky it sees; at most 64
    float occlusion_reach = 0.1F;     // of these rays, as a part of the grid's edge
    float detail_pixels = 0.0F;       // stop at nodes that are at most this many pixels wide; 0: go on to voxels
};

/// Depth beside a picture, as a host's projection has it, so that what the host draws is composited with voxels.
struct DepthTarget
{
    ImageTarget image; // D32_SFLOAT, D32_SFLOAT_S8_UINT or R32_SFLOAT
    /// From world to clip space, finite, the last row not 0: columns as Mat4's, depth in [0, 1] after the division: of
    /// the same camera.
    DMat4 view_projection{};
    float miss = 1.0F; // where rays hit nothing: the far end's depth, 0 where depth is reversed
};

/// Buffers in which pictures of one size and one kind of format are traced, one after the other: as many pictures
/// of a frame as there are, of all frames in flight. Another size or kind of format takes another Tracer.
class ZVO_API Tracer
{
public:
    /// format: of the images that pictures go to: R8G8B8A8 and B8G8R8A8, UNORM or SRGB (sRGB codes),
    /// A2B10G10R10_UNORM_PACK32 (sRGB codes), R16G16B16A16_SFLOAT (exposed radiance, linear, not tone-mapped). Memory:
    /// 28 bytes a pixel, 32 for half floats, 4 more where depth is asked for, and 18 MB. Throws Error{Usage} for other
    /// formats and for edges of 0 or more than 16384 pixels, Error{Memory}.
    Tracer(Context& context, std::uint32_t width, std::uint32_t height, VkFormat format);
    ~Tracer();
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;

    /// Records what traces a picture of a tree and copies it to the host's image, and its depth to another one. The
    /// picture is the bytes that `zvo render` writes, with the same options, on every device.
    ///
    /// First stages: ALL_TRANSFER, COMPUTE_SHADER and DRAW_INDIRECT, on resources of zvo; last stage: COPY. Edges of
    /// the images, which are the host's: before and after VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
    /// in ImageTarget::layout; images need VK_IMAGE_USAGE_TRANSFER_DST_BIT. Cost: pixels that are near something, and
    /// the copies.
    ///
    /// Throws Error{Usage} for images that are null, formats, layouts, offsets, extents, cameras, depth and numbers of
    /// TraceInfo that will not do (negative, not finite, no direction of the sun): then nothing is recorded. Throws
    /// what making a kernel throws: then no image is written.
    void trace(Recorder& recorder, const Tree& tree, const CameraInfo& camera, const TraceInfo& info,
               const ImageTarget& color, const DepthTarget* depth = nullptr);
    void trace(Recorder& recorder, DynamicTree& tree, const CameraInfo& camera, const TraceInfo& info,
               const ImageTarget& color, const DepthTarget* depth = nullptr);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/// A camera's rays as zvo/trace.glsl takes them (zvo_CameraRays, scalar layout): the same that Tracer::trace() follows
/// for a picture that is height pixels high, in a tree of that grid.
struct CameraRays
{
    Vec3 origin{};
    Vec3 forward{};
    Vec3 step_x{};
    Vec3 step_y{};
};

/// Throws Error{Usage} as Tracer::trace(), and for grids as TreeBuild.
ZVO_API CameraRays cameraRays(const CameraInfo& camera, const GridInfo& grid, std::uint32_t height);

} // namespace zvo
