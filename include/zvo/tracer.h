// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/dynamic_tree.h"
#include "zvo/export.h"
#include "zvo/image_target.h"
#include "zvo/light.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <memory>

namespace zvo
{

class RadianceCache; // zvo/radiance_cache.h

/// What a host's projection does beside projecting, for CameraInfo::ofMatrices().
struct ClipSpace
{
    bool y_up = false;           // a viewport of negative height: +1 is the picture's upper edge, -1 in Vulkan's own
    bool reversed_depth = false; // 1 is near, and 0 far; only orthographic cameras need it
};

/// The position and direction of a picture's view, in world space.
struct CameraInfo
{
    DVec3 position = {0, 0, 0};
    DVec3 forward = {0, 0, -1}; // any length; up need not be orthogonal to it
    DVec3 up = {0, 1, 0};
    bool orthographic = false;
    double vertical_fov = 0.7; // radians, inside (0, pi); perspective, of a picture whose middle is not shifted
    double half_height = 1.0;  // world units; orthographic
    double aspect = 0.0;       // what the picture shows in width over what it shows in height; 0: pixels are square
    DVec2 shift = {0, 0};      // of the picture's middle to its right and up, in halves of its width and height
    bool mirrored = false;     // right is that of a left-handed world: cross(up, forward)

    /// The camera of matrices by which the host draws, in columns as Mat4: what it shows at a pixel is what a
    /// rasterizer shows there. view: from world to view space, of either handedness, with any axis up. projection: from
    /// view to clip space, perspective or orthographic, with or without jitter, off-centre, mirrored, infinite, and
    /// with depth of any kind; if it is orthographic, from 0 to 1 in either order. Rays begin at the eye, those of an
    /// orthographic camera in its near plane. Throws Error{Usage} for numbers that are not finite, for a matrix that
    /// cannot be inverted, and for one that shears: whose pictures' rows and columns are not at right angles.
    [[nodiscard]] static ZVO_API CameraInfo ofMatrices(const DMat4& view, const DMat4& projection,
                                                       const ClipSpace& clip = {});

    /// The right-handed view from eye towards target, with y up (z for a view straight up or down), as `zvo render
    /// --camera` takes it, where the field of view is in degrees.
    [[nodiscard]] static ZVO_API CameraInfo lookAt(const DVec3& eye, const DVec3& target, double vertical_fov);
};

/// Options of a picture.
struct TraceInfo
{
    View view = View::Color;
    bool shadows = true;               // View::Color: a ray to the sun
    DVec3 to_sun = {-0.6, 0.75, 0.45}; // direction in the world, any length
    float sun = 2.2F;                  // strength
    float exposure = 1.0F;
    std::uint32_t occlusion_rays = 0;  // View::Color: rays for each hit that find how much sky it sees; at most 64
    float occlusion_reach = 0.1F;      // length of these rays, as a fraction of the grid's edge
    float detail_pixels = 0.0F;        // stop at nodes that are at most this many pixels wide; 0: go on to voxels
    Shading shading = Shading::Smooth; // View::Color
};

/// Options of a path-traced picture (docs/light.md).
struct PathInfo
{
    std::uint32_t bounces = 8;   // diffuse reflections of a path, at most 1024; 0: light that the camera sees directly
    std::uint32_t seed = 0;      // of the random numbers
    float lens_radius = 0.0F;    // world units; 0: a pinhole
    float focus_distance = 1.0F; // world units along CameraInfo::forward, where the picture is sharp; more than 0
    bool roulette = false;       // ends paths early that would bring little light, by chance
    Shading shading = Shading::Smooth; // of what the camera sees
    bool denoise = false;              // filters out the noise of few samples; each picture has its own random numbers

    // Another value of these does not begin anew.
    bool automatic_exposure = true; // by the picture's brightness, which is not known before (docs/light.md), times:
    float exposure = 1.0F;          // factor
    std::uint32_t samples = 1;      // paths of each pixel that a call adds, 1 to 1024
    std::uint32_t history_max = 16; // denoise: samples of earlier pictures that count at most in a pixel; 0: none
};

/// Options of a picture by the radiance cache.
struct CachedPictureInfo
{
    bool automatic_exposure = true; // as PathInfo's
    float exposure = 1.0F;
    Shading shading = Shading::Smooth;
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
/// pictures in a frame, and all frames in flight. Another size or kind of format needs another Tracer, and so does each
/// picture that tracePaths() makes in the course of frames.
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

    /// Records the passes that add samples to each pixel of a path-traced picture, and the copy of the picture so far
    /// to the host's image. Samples add up over calls, recordings and frames, for as long as nothing changes that the
    /// picture shows: it begins anew by itself where the tree, the environment, the camera or one of the options above
    /// automatic_exposure is not that of the last call, and after a call that failed or whose frame was lost. On every
    /// device the picture has the same bytes as that of `zvo render --integrator path` with the same options and as
    /// many samples; with PathInfo::denoise, that goes for the first picture of a Tracer.
    ///
    /// With PathInfo::denoise, light of earlier pictures counts, too, where they show the same place by the same light:
    /// after the camera has moved, or the tree has changed. It does not after another option but the seed,
    /// forgetSamples(), and a call that failed or whose frame was lost.
    ///
    /// Stages, barriers and what images need: as trace(). Memory, from the first call on: 16 bytes a pixel; 252 for
    /// each of the pixels whose paths advance together, at most 524,288; 0.1 MB; and for lights of the tree at most 76
    /// bytes an emissive voxel, and 88 more for each second level of the tree. From the first call with
    /// PathInfo::denoise on, 152 bytes a pixel more, and 4 for each of the pixels whose paths advance together. Cost:
    /// pixels times samples, times two rays for each bounce; to denoise, pixels.
    ///
    /// Throws Error{Usage} as trace() does for images and cameras, for numbers of PathInfo that are out of range,
    /// negative or not finite, and for an environment that was lost; then nothing is recorded, and the samples stay.
    /// Throws Error{Memory}, and what making a kernel throws; then no image is written.
    void tracePaths(Recorder& recorder, const Tree& tree, Environment& environment, const CameraInfo& camera,
                    const PathInfo& info, const ImageTarget& color);
    void tracePaths(Recorder& recorder, DynamicTree& tree, Environment& environment, const CameraInfo& camera,
                    const PathInfo& info, const ImageTarget& color);

    /// Records the passes that show the radiance cache, and the copy of the picture to the host's image:
    /// the camera's rays, the light where they hit, lamps and what is outside, as `zvo render --integrator cache`
    /// shows them. tree, environment: those of the last RadianceCache::update(), which comes before, unchanged since.
    /// The camera may be another one, and the picture larger than the rays that the light has: faces that these have
    /// not found show the light of a brick around them, or are black where none keeps any.
    ///
    /// Stages, barriers and what images need: as trace(). Memory, from the first call on: at most 20 bytes a pixel.
    /// Cost: pixels.
    ///
    /// Throws Error{Usage} as trace() does for images and cameras, for an exposure that is negative or not finite, for
    /// an environment that was lost, and where update() has not come before; then nothing is recorded. Throws
    /// Error{Memory}, and what making a kernel throws; then no image is written.
    void traceCached(Recorder& recorder, const Tree& tree, Environment& environment, RadianceCache& light,
                     const CameraInfo& camera, const CachedPictureInfo& info, const ImageTarget& color);
    void traceCached(Recorder& recorder, DynamicTree& tree, Environment& environment, RadianceCache& light,
                     const CameraInfo& camera, const CachedPictureInfo& info, const ImageTarget& color);

    /// Samples of each pixel in the picture that tracePaths() has recorded last; 0: none, or the call failed, or its
    /// frame was lost.
    [[nodiscard]] std::uint32_t sampleCount() const;

    /// Has the next tracePaths() begin anew, without light of earlier pictures. Records nothing.
    void forgetSamples();

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/// A camera's rays as zvo/trace.glsl takes them (zvo_CameraRays, scalar layout): the same that Tracer::trace() follows
/// for a picture of width x height pixels, in a tree of that grid.
struct CameraRays
{
    Vec3 origin{};
    Vec3 forward{};
    Vec3 half_pixel_x{}; ///< to the right
    Vec3 half_pixel_y{}; ///< down
};

/// Throws Error{Usage} as Tracer::trace(), and for grids as TreeBuild.
ZVO_API CameraRays cameraRays(const CameraInfo& camera, const GridInfo& grid, std::uint32_t width,
                              std::uint32_t height);

} // namespace zvo
