// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/camera.h"
#include "path/path.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// What a picture shows beside its light, row by row from the top left: means over the samples of each pixel.
struct AovImages
{
    /// Depth of pixels that see nothing.
    static constexpr float kNoDepth = 1e10F;
    static constexpr float kNoMotion = 1e10F;

    std::vector<glm::vec3> albedo; // of faces; samples that hit none count as 0, here and in the normals
    std::vector<glm::vec3> normal; // of faces, world space
    std::vector<float> depth;      // world units along the camera's direction, of the samples that hit a face
    /// Pixels, right and down, to where the place, or the direction of the sky, was in the picture before; kNoMotion
    /// where that was behind the camera.
    std::vector<glm::vec2> motion;
};

/// The images of GuidedPicture::features, of at least one sample. camera_before: of the picture before. The motion is
/// that of the camera alone: voxels have no identity over time.
AovImages aovsOf(std::span<const gpu::PixelFeatures> features, std::uint32_t width, std::uint32_t height,
                 std::uint32_t sample_count, const Grid& grid, const TraceCamera& camera,
                 const TraceCamera& camera_before);

} // namespace zvo
