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
    glm::dvec3 forward{0.0, 0.0, -1.0}; // forward, right and up: length 1, orthogonal
    glm::dvec3 right{1.0, 0.0, 0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    bool orthographic = false;
    double vertical_fov = 0.7; // radians; perspective
    double half_height = 1.0;  // world units; orthographic

    /// A scene's camera. Scale and shear of its transform are dropped. Throws Error{Input} if nothing is left.
    static ViewCamera of(const Camera& camera);

    /// From eye towards target with y up (z for a view straight up or down). Throws Error{Usage} if they are the same
    /// point or not finite, or if the field of view (radians) is not inside (0, pi).
    static ViewCamera lookAt(const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov);

    /// A three-quarter view from the front, right and above in which the scene's vertices fill a picture whose width is
    /// aspect times its height, as near as that goes.
    static ViewCamera framing(const Scene& scene, double aspect);

    /// The same for the corners of a box.
    static ViewCamera framing(const Bounds& bounds, double aspect);

    /// This camera turned about the vertical axis through centre, counterclockwise as seen from above.
    [[nodiscard]] ViewCamera turnedAround(const glm::dvec3& center, double radians) const;
};

/// A camera as the kernels take it.
struct TraceCamera
{
    gpu::CameraRays rays;
    bool orthographic = false;
};

/// The rays of a picture that is height pixels high (not 0), in the unit space of grid's octree, computed in double
/// precision. Pixels are square, so the width does not matter.
TraceCamera traceCamera(const ViewCamera& camera, const Grid& grid, std::uint32_t height);

} // namespace zvo
