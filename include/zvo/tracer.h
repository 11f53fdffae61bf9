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

/// The position and direction of a picture's view, in world space. Pixels are square.
struct CameraInfo
{
    DVec3 position = {0, 0, 0};
    DVec3 forward = {0, 0, -1}; // any length; up need not be orthogonal to it
    DVec3 up = {0, 1, 0};
    bool orthographic = false;
    double vertical_fov = 0.7; // radians, inside (0, pi); perspective
    double half_height = 1.0;  // world units; orthographic

    /// The view from eye towards target, with y up (z for a view straight up or down), as `zvo render --camera` takes
    /// it, where the field of view is in degrees.
    [[nodiscard]] static ZVO_API CameraInfo lookAt(const DVec3& eye, const DVec3& target, double vertical_fov);
};

/// Options of a picture.
struct TraceInfo
{
    View view = View::Color;
    bool shadows = true;               // View::Color: a ray to the sun
    DVec3 to_sun = {-0.6, 0.75, 0.45}; // direction, any length
    float sun = 2.2F;                  // strength
    float exposure = 1.0F;
    std::uint32_t occlusion_rays = 0; // View::Color: rays for each hit that find how much sky it sees; at most 64
    float occlusion_reach = 0.1F;     // length of these rays, as a fraction of the grid's edge
    float detail_pixels = 0.0F;       // stop at nodes that are at most this many pixels wide; 0: go on to voxels
};

/// A depth image beside a picture, in the host's own projection, so that the host can composite voxels with what it
/// draws.
struct DepthTarget
{
    ImageTarget image; // D32_SFLOAT, D32_SFLOAT_S8_UINT or R32_SFLOAT
    /// The matrix from world to clip space of the same camera, in columns as Mat4. Finite, the last row not 0, depth in
    /// [0, 1] after the division.
    DMat4 view_projection{};
    float miss = 1.0F; // depth where rays hit nothing: 0 where depth is reversed
};

/// Buffers in which pictures of one size and format are traced, one after the other. One Tracer serves any number of
/// pictures in a frame, and all frames in flight. Another size or kind of format needs another Tracer.
class ZVO_API Tracer
{
public:
    /// format: that of the images which receive the pictures: R8G8B8A8 or B8G8R8A8, UNORM or SRGB (sRGB codes),
    /// A2B10G10R10_UNORM_PACK32 (sRGB codes), or R16G16B16A16_SFLOAT (exposed radiance, linear, not tone-mapped).
    /// Memory: 28 bytes a pixel, 32 for half floats, 4 more where depth is asked for, and 18 MB. Throws Error{Usage}
    /// for other formats and for edges of 0 or more than 16384 pixels, and Error{Memory}.
    Tracer(Context& context, std::uint32_t width, std::uint32_t height, VkFormat format);
    ~Tracer();
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;

    /// Records the passes that trace a picture of a tree, and the copies of the picture to the host's image and of its
    /// depth to another one. On every device the picture has the same bytes as that of `zvo render` with the same
    /// options.
    ///
    /// First stages: ALL_TRANSFER, COMPUTE_SHADER and DRAW_INDIRECT, on resources of zvo; last stage: COPY. Barriers
    /// for the images are the host's: before and after VK_PIPELINE_STAGE_2_COPY_BIT with
    /// VK_ACCESS_2_TRANSFER_WRITE_BIT, in ImageTarget::layout. Images need VK_IMAGE_USAGE_TRANSFER_DST_BIT. Cost:
    /// pixels that are near something, and the copies.
    ///
    /// Throws Error{Usage} for images that are null; for formats, layouts, offsets, extents, cameras and depth targets
    /// that are not valid; and for numbers of TraceInfo that are negative or not finite, or a direction to the sun of
    /// length 0. Then nothing is recorded. Throws what making a kernel throws; then no image is written.
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
    Vec3 half_pixel_x{}; ///< to the right
    Vec3 half_pixel_y{}; ///< down
};

/// Throws Error{Usage} as Tracer::trace(), and for grids as TreeBuild.
ZVO_API CameraRays cameraRays(const CameraInfo& camera, const GridInfo& grid, std::uint32_t height);

} // namespace zvo
