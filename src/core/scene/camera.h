// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "trace/trace.h"

#include <cstdint>

namespace zvo
{

/// Where a picture is taken from, in world space.
struct ViewCamera
{
    glm::dvec3 position{0.0};
    glm::dvec3 forward{0.0, 0.0, -1.0}; // forward, right and up: length 1, orthogonal, of either handedness
    glm::dvec3 right{1.0, 0.0, 0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    bool orthographic = false;
    double vertical_fov = 0.7; // radians; perspective
    double half_height = 1.0;  // world units; orthographic
    double pixel_aspect = 1.0; // width of a pixel over its height
    glm::dvec2 shift{0.0};     // of the picture's middle from forward, along right and up, in halves of its height

    bool operator==(const ViewCamera&) const = default;

    /// The view of a scene's camera. Scale and shear of its transform are dropped. Throws Error{Input} if nothing is
    /// left.
    static ViewCamera of(const Camera& camera);

    /// The view from eye towards target, with y up (z for a view straight up or down). vertical_fov: radians. Throws
    /// Error{Usage} if eye and target are the same point or not finite, or if vertical_fov is not inside (0, pi).
    static ViewCamera lookAt(const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov);

    /// A three-quarter view from the front, right and above, so near that a box just fits into a picture whose width is
    /// aspect times its height, and in its middle.
    static ViewCamera framing(const Bounds& bounds, double aspect);

    /// The same along any direction but 0.
    static ViewCamera framing(const Bounds& bounds, double aspect, const glm::dvec3& direction);

    /// This camera turned about the vertical axis through centre, counterclockwise as seen from above.
    [[nodiscard]] ViewCamera turnedAround(const glm::dvec3& center, double radians) const;
};

/// A camera in the form that the kernels take.
struct TraceCamera
{
    gpu::CameraRays rays;
    gpu::vec3 axis; // PictureCamera's
    bool orthographic = false;

    [[nodiscard]] gpu::PictureCamera inPicture() const { return {rays, axis}; }
};

/// The rays of a picture that is height pixels high (not 0), in the unit space of grid's octree, computed in double
/// precision.
TraceCamera traceCamera(const ViewCamera& camera, const Grid& grid, std::uint32_t height);

/// The camera whose rays go through other points of the pixels: so many pixels to the right and down from the middle.
TraceCamera shifted(const TraceCamera& camera, const glm::vec2& pixels);

/// Where the rays of a sample go through pixels, from their middles: evenly over them in any number of samples, and in
/// the middle in the first (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018).
glm::vec2 pointOfPixel(std::uint32_t sample);

} // namespace zvo
