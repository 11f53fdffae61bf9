// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/export.h"
#include "zvo/types.h"

#include <cstdint>
#include <memory>
#include <span>

namespace zvo
{

/// The sun: a disc of 0.53 degrees. By default, that of `zvo render`.
struct SunInfo
{
    DVec3 direction = {-0.6, 0.75, 0.45};                // towards it, any length
    DVec3 irradiance = {2.2F, 2.2F * 0.93, 2.2F * 0.82}; // of a surface that faces it, over pi; at most 1e30; 0: no sun
};

/// The sun of `zvo render` in a direction: the lower it is, the redder, and below the horizon it gives no light. Throws
/// Error{Usage} for a direction without a length. up: ContextInfo's.
ZVO_API SunInfo sunlight(const DVec3& direction, const DVec3& up = {0, 1, 0});

/// A picture of all directions in equirectangular form: up is +y, the middle is -z, and +x is a quarter of the width to
/// the right of it. With another ContextInfo::up all of it is turned by the least angle that brings +y there: in a
/// world whose z is up, the middle is +y. In a left-handed world it is mirrored. Its texels are copied: the array is
/// not needed after the call.
struct EnvironmentMapInfo
{
    std::uint32_t width = 0; // at most 16384, as height; texels at most 2^25
    std::uint32_t height = 0;
    std::span<const Vec3> texels; // [width * height] rows from the top, linear radiance in the primaries of sRGB
    double turn = 0.0;            // radians by which the map is turned about up, counterclockwise as seen from above
    float strength = 1.0F;        // factor
    float background_blur = 0.0F; // radians, to pi: the camera sees the map blurred by this; its light stays
};

/// Light from outside of the grid, for Tracer::tracePaths(): a map or the simple sky, and a sun. Any number of tracers
/// may use it, in all frames in flight. Move-only; as a Tree, it throws Error{Usage} when it is used after it was moved
/// from or lost with its frame.
class ZVO_API Environment
{
public:
    /// Records what makes the simple sky of zvo's pictures; its sun is SunInfo's. Its colours, from day to night,
    /// follow the direction of the sun, whose light is what the host says (sunlight()). Device memory: 10 MB. Throws
    /// Error{Memory}. First stages: ALL_TRANSFER and COMPUTE_SHADER; last stage: COMPUTE_SHADER; on resources of zvo.
    explicit Environment(Recorder& recorder);

    /// Records the upload of a map, and the passes that make the tables by which paths find its light. It has no sun.
    /// Device memory: 12 bytes a texel, and 288 for each cell of the tables, of which there are as many as texels, at
    /// least 16 along an edge and at most 524,288; of a blurred background, up to 12 bytes a texel more. It is made at
    /// once, on the processor: a second where it has 500,000 texels. Until the frame is done, staging buffers take 12
    /// bytes a texel more. Cost: texels, also of looking at each. Throws Error{Usage} for sizes out of range, for
    /// another number of texels, for a texel that is negative or not finite, here or times strength, which the message
    /// names, for a turn that is not finite, for a strength that is negative or not finite, and for a blur out of
    /// range; then nothing is recorded. Throws Error{Memory}. Stages as above.
    Environment(Recorder& recorder, const EnvironmentMapInfo& map);
    ~Environment();
    Environment(Environment&&) noexcept;
    Environment& operator=(Environment&&) noexcept;

    /// Sets the sun. Records nothing; the next tracePaths() sees it, and begins anew where it is another one. Throws
    /// Error{Usage} for a direction without a length, and for irradiance that is negative, not finite or too much.
    void setSun(const SunInfo& sun);

    struct Impl;
    [[nodiscard]] Impl* impl() const { return m_impl.get(); } // only for the library; null once moved from

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
